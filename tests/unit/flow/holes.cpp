// SPDX-License-Identifier: GPL-3.0-or-later
// Inclusions that pierce a sheet, and the holes that they open.
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/flow/exposure.h"
#include "libsheet/flow/holes.h"
#include "libsheet/flow/tear.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/contact_spring.h"
#include "tests/support/meshes.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet::flow {
namespace {

using formats::Frame;
using test::momentum;
using test::total;
using test::volume_of;

constexpr scene::Inclusions law{.number = 1e4, .at_thickness = 1e-3, .exponent = 6, .seed = 1};

Scene scene_with(const std::string& tear, const std::string& more = "") {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nedge_length = 1\nthickness = 0.25\n[material]\n"
                     "viscosity = 1\ndensity = 3\nsurface_tension = 0.1\n[tear]\n" +
                         tear + more,
                     "scene");
}

// A flat disk of radius 1 m, that turns and falls.
Frame disk(int rings, double deep) {
  const test::Mesh mesh = test::disk(1, rings, 0.2);
  Frame frame = make_frame(mesh.positions, mesh.triangles, std::vector<double>(mesh.triangles.size(), 1));
  for (std::size_t t = 0; t < frame.triangles; ++t)
    volumes(frame)[t] = deep * test::area(frame, t);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    velocities(frame)[v] = Vector3(0, 0, -1) + Vector3(0, 0, 2).cross(positions(frame)[v]);
  return frame;
}

std::vector<double> areas(const Frame& frame) {
  std::vector<double> all;
  for (std::size_t t = 0; t < frame.triangles; ++t)
    all.push_back(test::area(frame, t));
  return all;
}

// The triangle at a place, as a site.
Site site_at(const Frame& frame, const Vector3& place) {
  Site site{0, place};
  double nearest = std::numeric_limits<double>::infinity();
  const auto x = positions(frame);
  for (std::uint32_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    if (const double d = ((x[c[0]] + x[c[1]] + x[c[2]]) / 3 - place).norm(); d < nearest) {
      nearest = d;
      site.triangle = t;
    }
  }
  return site;
}

std::size_t rims(const Frame& frame) {
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  std::size_t on_rim = 0;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    on_rim += mesh.on_rim(e);
  return on_rim;
}

// V - E + F: 1 for a disk, less by 1 for each hole.
long euler(const Frame& frame) {
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  return static_cast<long>(frame.vertices) - static_cast<long>(mesh.edges.size()) + static_cast<long>(frame.triangles);
}

std::vector<bool> none(const Frame& frame) { return std::vector<bool>(frame.vertices, false); }

TEST(Exposure, IsVolumeTimesSitesAtTheLeastThickness) {
  Frame frame = disk(6, 1e-3);
  (void)draw_sites(frame, law, areas(frame), none(frame));
  const formats::Array* array = frame.find("tear.exposure");
  ASSERT_NE(array, nullptr);
  EXPECT_EQ(array->transfer, formats::Transfer::conserve);
  EXPECT_NEAR(total(array->values<double>()), 1e4 * volume_of(frame), 1e-9);
  const auto scaled = [&](double by) {
    for (Vector3& x : positions(frame))
      x *= by;
    (void)draw_sites(frame, law, areas(frame), none(frame));
    return total(frame.find("tear.exposure")->values<double>());
  };
  EXPECT_NEAR(scaled(std::sqrt(2)), 64e4 * volume_of(frame), 1e-6); // half as thick
  EXPECT_NEAR(scaled(0.5), 64e4 * volume_of(frame), 1e-6);          // thicker: stays
  EXPECT_NEAR(scaled(2), 64e4 * volume_of(frame), 1e-6);            // no thinner than before
}

TEST(Exposure, OfWhatIsSupportedWaits) {
  Frame frame = disk(6, 1e-3);
  std::vector<bool> supported(frame.vertices, true);
  EXPECT_TRUE(draw_sites(frame, law, areas(frame), supported).empty());
  EXPECT_EQ(total(frame.find("tear.exposure")->values<double>()), 0);
  EXPECT_FALSE(draw_sites(frame, law, areas(frame), none(frame)).empty());
}

// Sites as their number says, in their triangles, other ones in another step and for another seed.
TEST(Exposure, DrawsByStepAndSeed) {
  const Frame start = disk(20, 1e-3);
  const auto drawn = [&](std::uint64_t step, std::int64_t seed) {
    Frame frame = start;
    frame.step = step;
    scene::Inclusions few = law;
    few.number = 100 / volume_of(frame);
    few.seed = seed;
    std::vector<std::uint32_t> found;
    for (const Site& site : draw_sites(frame, few, areas(frame), none(frame))) {
      found.push_back(site.triangle);
      const Corners& c = triangles(std::as_const(frame))[site.triangle];
      const auto x = positions(std::as_const(frame));
      const double whole = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).z();
      for (int k = 0; k < 3; ++k)
        EXPECT_GE((x[c[(k + 1) % 3]] - x[c[k]]).cross(site.place - x[c[k]]).z(), -1e-12 * whole);
    }
    return found;
  };
  const auto first = drawn(7, 1);
  EXPECT_NEAR(static_cast<double>(first.size()), 100, 30); // three standard deviations
  EXPECT_EQ(drawn(7, 1), first);
  EXPECT_NE(drawn(8, 1), first);
  EXPECT_NE(drawn(7, 2), first);
}

// Thick edges: the star of a vertex. Fine ones: as many as half a thickness needs.
TEST(Holes, AreAStarOrHalfAThicknessWide) {
  for (const double deep : {0.05, 1.0}) {
    Frame frame = disk(24, deep);
    const std::vector<Site> sites{site_at(frame, {0.1, 0.05, 0})};
    const double volume = volume_of(frame), area = total(areas(frame)), rim = static_cast<double>(rims(frame));
    const Vector3 before = momentum(frame);
    EXPECT_EQ(open_holes(frame, sites, none(frame)).opened, 1U);
    EXPECT_NEAR(volume_of(frame), volume, 1e-14 * volume);
    EXPECT_NEAR((momentum(frame) - before).norm(), 0, 1e-14 * before.norm());
    EXPECT_EQ(euler(frame), 0);
    const double radius = std::sqrt((area - total(areas(frame))) / std::numbers::pi);
    if (deep < 0.1) {
      EXPECT_NEAR(static_cast<double>(rims(frame)) - rim, 6, 2);
    } else {
      EXPECT_GE(radius, 0.5 * deep);
      EXPECT_LE(radius, 0.6 * deep);
    }
    EXPECT_EQ(test::value_error(frame), "");
  }
}

// The liquid goes to the ring, evenly; nothing else gets thicker. Exposure stays with it.
TEST(Holes, GiveTheirLiquidToTheRing) {
  Frame frame = disk(12, 0.01);
  (void)draw_sites(frame, law, areas(frame), none(frame));
  const double exposure = total(frame.find("tear.exposure")->values<double>());
  const std::vector<Site> sites{site_at(frame, {0, 0, 0})};
  (void)open_holes(frame, sites, none(frame));
  EXPECT_NEAR(total(frame.find("tear.exposure")->values<double>()), exposure, 1e-12 * exposure);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const double deep = volumes(frame)[t] / test::area(frame, t), r = positions(frame)[triangles(frame)[t][0]].norm();
    EXPECT_GE(deep, 0.01 * (1 - 1e-12));
    EXPECT_LE(deep, r > 0.3 ? 0.01 * (1 + 1e-12) : 0.015);
  }
}

// Beside a rim and at one place they open at the nearest vertices that have room; the rim stays as it was.
TEST(Holes, KeepClearOfRimsAndOfEachOther) {
  Frame frame = disk(12, 0.01);
  const std::size_t rim = rims(frame);
  std::vector<Site> sites(9, site_at(frame, {0.3, 0, 0}));
  sites.push_back(site_at(frame, {-0.97, 0, 0}));
  const Holes holes = open_holes(frame, sites, none(frame));
  EXPECT_GE(holes.opened, 3U);
  EXPECT_GE(holes.without_room, 1U);
  EXPECT_EQ(holes.opened + holes.without_room, sites.size());
  EXPECT_EQ(euler(frame), 1 - static_cast<long>(holes.opened));
  std::size_t outside = 0;
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    outside += mesh.on_rim(e) && positions(frame)[mesh.edges[e][0]].norm() > 1 - 1e-9;
  EXPECT_EQ(outside, rim);
}

// Where no hole has room the sheet parts: across strips of one and two triangles, and nowhere else.
TEST(Holes, PartStripsThatAreTooNarrow) {
  for (const std::uint32_t rows : {1U, 2U}) {
    Frame frame = test::grid(40, rows, 0.1, 0.01);
    for (std::size_t v = 0; v < frame.vertices; ++v)
      velocities(frame)[v] = Vector3(0, 0, positions(frame)[v].x());
    const double volume = volume_of(frame);
    const Vector3 before = momentum(frame);
    const Torn torn = tear(frame, scene_with("sites = 200\nat_thickness = 1e-2\nexponent = 6\n"));
    EXPECT_EQ(torn.holes, 0U);
    EXPECT_GE(torn.without_room, 1U);
    EXPECT_GE(torn.edges, rows);
    EXPECT_GE(euler(frame), 2); // pieces, each a disk
    EXPECT_NEAR(volume_of(frame), volume, 1e-15);
    EXPECT_NEAR((momentum(frame) - before).norm(), 0, 1e-15);
  }
}

TEST(Holes, OpenNotWhereVerticesAreSupported) {
  Frame frame = disk(12, 0.01);
  const Frame before = frame;
  const std::vector<Site> sites{site_at(frame, {0.2, 0, 0})};
  std::vector<bool> supported(frame.vertices, true);
  EXPECT_EQ(open_holes(frame, sites, supported).without_room, 1U);
  EXPECT_EQ(frame, before);
}

// A sphere that is pierced all over keeps at least a crumb, and all of its liquid.
TEST(Holes, LeaveSomething) {
  const test::Mesh mesh = test::icosphere(1);
  Frame frame = make_frame(mesh.positions, mesh.triangles, std::vector<double>(mesh.triangles.size(), 0.01));
  const Scene scene = scene_with("sites = 1e6\nat_thickness = 1\nexponent = 3\n");
  std::size_t holes = 0;
  for (frame.step = 0; frame.step < 20; ++frame.step)
    holes += tear(frame, scene).holes;
  EXPECT_GE(holes, 1U);
  EXPECT_GE(frame.triangles, 8U);
  EXPECT_NEAR(volume_of(frame), 0.8, 1e-14);
}

// Held vertices, what touches, and layers in contact are left whole; a frame without sites in its scene is the same.
TEST(Holes, OfAFrame) {
  const std::string sites = "sites = 2000\nat_thickness = 1e-2\nexponent = 6\n";
  const auto opened = [&](Frame frame, const std::string& more = "") {
    return tear(frame, scene_with(sites, more)).holes;
  };
  const Frame free = disk(12, 0.01);
  EXPECT_GT(opened(free), 5U);
  Frame held = free;
  for (std::uint64_t& bits : put_masks(held, "hold"))
    bits = 1;
  EXPECT_EQ(opened(held, "[[hold]]\nregion = \"rim\"\n"), 0U);
  EXPECT_GT(opened(held, "[[hold]]\nregion = \"rim\"\naxes = \"z\"\n"), 5U);
  Frame enters = free;
  for (std::uint64_t& bits : put_masks(enters, "inlet"))
    bits = in_inlet;
  EXPECT_EQ(opened(enters), 0U);
  Frame touches = free;
  put_touched_solids(touches, std::vector<std::int32_t>(touches.vertices, 0), 1);
  EXPECT_EQ(opened(touches, "[[solid]]\nshape = \"plane\"\n"), 0U);
  Frame layered = free;
  std::vector<ContactSpring> springs;
  for (std::uint32_t v = 0; v + 3 < layered.vertices; v += 4) {
    springs.emplace_back();
    springs.back().vertices = {v, v + 1, v + 2, v + 3};
    springs.back().weights = {1, -0.5, -0.25, -0.25};
    springs.back().rest = 0.01;
  }
  write_springs(layered, springs);
  EXPECT_LT(opened(layered), opened(free) / 3);
  Frame whole = free;
  EXPECT_EQ(tear(whole, scene_with("below = 1e-4\n")).holes, 0U);
  EXPECT_EQ(whole, free);
}

} // namespace
} // namespace sheet::flow
