// SPDX-License-Identifier: GPL-3.0-or-later
// V41: how many holes open at inclusions, and when, against Poisson's and Weibull's laws. V42: how fast a hole grows,
// in a film at rest and in a curtain.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "libsheet/flow/exposure.h"
#include "libsheet/flow/holes.h"
#include "libsheet/flow/tear.h"
#include "libsheet/geometry/area.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "tests/validation/round_hole.h"
#include "tests/validation/setup.h"
#include "tests/validation/stages.h"

namespace sheet::validation {

namespace {

using formats::Frame;

std::vector<double> areas(const Frame& frame) {
  const auto x = positions(frame);
  std::vector<double> all;
  for (const Corners& c : triangles(frame))
    all.push_back(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area);
  return all;
}

double total(std::span<const double> of) {
  double sum = 0;
  for (const double one : of)
    sum += one;
  return sum;
}

// A sphere of radius 1 m is inflated in equal factors until it is 0.1 as thick; the thickness at its first hole over
// 400 seeds. A volume V that thins evenly has no hole with probability exp(-V N(h)). Value: Kolmogorov's distance from
// that, of the steps' ends.
Result first_holes(const Settings& s) {
  constexpr double start = 1e-3, thinned = 0.1;
  constexpr int seeds = 400;
  const TriangleMesh mesh = make_sphere(1, mesh_options(s, 1));
  const State film_ = film(mesh, start);
  Frame first = make_frame(film_.positions, film_.mesh->triangles, film_.volumes);
  const std::vector<double> area = areas(first);
  const double volume = total(film_.volumes);
  // So that half of the spheres have a hole when they are thinned to the root of 0.1.
  scene::Inclusions inclusions{.at_thickness = start * std::sqrt(thinned), .exponent = 6};
  inclusions.number = std::log(2.0) / volume;
  const std::vector<bool> free(first.vertices, false);
  std::vector<int> opened(static_cast<std::size_t>(s.steps) + 1, 0); // by then
  for (int seed = 1; seed <= seeds; ++seed) {
    inclusions.seed = seed;
    Frame frame = first;
    std::vector<double> now = area;
    for (int k = 1; k <= s.steps; ++k) {
      frame.step = static_cast<std::uint64_t>(k);
      const double thinner = std::pow(thinned, static_cast<double>(k) / s.steps);
      for (std::size_t t = 0; t < now.size(); ++t)
        now[t] = area[t] / thinner;
      if (flow::draw_sites(frame, inclusions, now, free).empty())
        continue;
      for (int later = k; later <= s.steps; ++later)
        ++opened[static_cast<std::size_t>(later)];
      break;
    }
  }
  Result r;
  const double thickness = volume / total(area);
  for (int k = 1; k <= s.steps; ++k) {
    const double h = thickness * std::pow(thinned, static_cast<double>(k) / s.steps);
    const double exact = 1 - std::exp(-volume * flow::piercing(inclusions, h));
    r.value = std::max(r.value, std::abs(opened[static_cast<std::size_t>(k)] / static_cast<double>(seeds) - exact));
  }
  r.error = r.value;
  r.vertices = first.vertices;
  r.edge = s.edge;
  r.steps = s.steps;
  return r;
}

// A square film of 0.4 m and uneven thickness is drawn out to 0.88 m in `steps`, as a flow prescribes it, and remeshed;
// in 40 seeds. Value: holes over those that Poisson's law lets expect, the sum of V N(h) over the film when it is drawn
// out; `expected` is that number, so that of its root is the error of one standard deviation. `exposure` is what it had
// at the end, less than that by what holes have taken up and remeshing has levelled.
Result number_of_holes(const Settings& s) {
  constexpr int seeds = 40;
  constexpr double side = 0.4, stretch = 2.2, h = 2e-3;
  Result r;
  double holes = 0, expected = 0, exposure = 0, without_room = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const std::string wave = "{of = \"thickness\", amplitude = 3e-4, wavelength = 0.2, direction = ";
    const Scene scene = parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nplane = \"xy\"\nsize = [{}, {}]\nedge_length = {}\nthickness = "
                    "{}\nseed = {}\nperturbation = [{}\"x\"}}, {}\"y\"}}]\n[material]\nviscosity = 1\n[model]\n"
                    "inertia = false\n[tear]\nsites = 3e3\nat_thickness = 1e-3\nexponent = 6\nseed = {}\n",
                    side, side, s.edge, h, s.seed, wave, wave, seed),
        "validation case");
    Frame frame = build_frame(scene);
    const std::vector<double> first = areas(frame);
    for (std::size_t t = 0; t < frame.triangles; ++t)
      expected += volumes(frame)[t] * flow::piercing(*scene.tear->inclusions, volumes(frame)[t] / (stretch * first[t]));
    remesh::Options remeshing;
    remeshing.size.edge_length = s.edge;
    for (int k = 1; k <= s.steps; ++k) {
      for (Vector3& x : positions(frame))
        x.x() *= std::pow(stretch, 1.0 / s.steps);
      frame.step = static_cast<std::uint64_t>(k);
      (void)remesh::remesh(frame, &scene, remeshing);
      const flow::Torn torn = flow::tear(frame, scene);
      holes += static_cast<double>(torn.holes);
      without_room += static_cast<double>(torn.without_room);
    }
    r.vertices = frame.vertices;
    exposure += total(frame.find("tear.exposure")->values<double>());
  }
  r.value = holes / expected;
  r.error = r.value - 1;
  r.edge = s.edge;
  r.steps = s.steps;
  r.more = {{"expected", expected}, {"holes", holes}, {"exposure", exposure}, {"without_room", without_room}};
  return r;
}

constexpr double tension = 0.07, density = 1000;
constexpr double most = 0.022; // radius to which holes grow [m]

// Oh 0.05.
double viscosity_of(double thickness) { return 0.05 * std::sqrt(tension * density * thickness); }

// The speed at which a film draws open far from where a hole began, √(2 γ/(ρ h)) [Taylor 1959; Culick 1960].
double retraction(double thickness) { return std::sqrt(2 * tension / (density * thickness)); }

// What a hole of this first radius does in a wide film of which the triangles around it have its liquid, as those of
// the edge length do (round_hole.h).
std::vector<HoleRadius> exact_growth(double thickness, double first, double last, double edge) {
  constexpr double wide = 0.03, rings_a_rim = 16; // the rim's diameter is √(2 R h/π)
  const double rim = std::sqrt(2 * (most / 4) * thickness / pi);
  return growth_of_hole({.thickness = thickness,
                         .first = first,
                         .border = edge,
                         .outer = wide,
                         .density = density,
                         .surface_tension = tension,
                         .viscosity = viscosity_of(thickness)},
                        last, rim / rings_a_rim);
}

// Opens one at the vertex nearest to a place.
void open_hole(Frame& frame, const Vector3& place) {
  const auto x = positions(std::as_const(frame));
  const auto corners = triangles(std::as_const(frame));
  std::uint32_t nearest = 0;
  const auto way = [&](std::uint32_t t) {
    return ((x[corners[t][0]] + x[corners[t][1]] + x[corners[t][2]]) / 3 - place).norm();
  };
  for (std::uint32_t t = 1; t < frame.triangles; ++t)
    if (way(t) < way(nearest))
      nearest = t;
  const flow::Site site{nearest, place};
  (void)flow::open_holes(frame, {&site, 1}, std::vector<bool>(frame.vertices, false));
}

std::string film_scene(const std::string& sheet, const Settings& s, double thickness, const std::string& more) {
  return fmt::format(
      "[sheet]\n{}plane = \"xy\"\nedge_length = {}\nthickness = {}\nseed = {}\n[material]\nviscosity = {}\n"
      "density = {}\nsurface_tension = {}\n[model]\nbending = false\nfaces = true\n[[hold]]\nregion = "
      "{{box = [[-1, -1, -1], [1, 1, 1]]}}\naxes = \"z\"\n{}",
      sheet, s.edge, thickness, s.seed, viscosity_of(thickness), density, tension, more);
}

double area_of(const Frame& frame) { return total(areas(frame)); }

// A film of 30 mm radius, held at its rim; a hole opens in its middle, and grows to 22 mm. Value: its mean speed from 3
// times its first radius on over that of the film in one dimension; over √(2 γ/(ρ h)) it is `of_culick`.
Result hole_in_film(const Settings& s, double thickness) {
  constexpr double radius = 0.03;
  Settings own = s;
  own.edge = s.edge * radius;
  std::vector<std::pair<double, double>> radii; // over time
  double whole = 0;
  const auto measure = [&](const Frame& frame) {
    radii.emplace_back(frame.time, std::sqrt((whole - area_of(frame)) / pi));
  };
  const Staged run = run_stages(film_scene(fmt::format("shape = \"disk\"\nradius = {}\n", radius), own, thickness,
                                           "[[hold]]\nregion = \"rim\"\n"),
                                own, most / retraction(thickness), measure, [&](Frame& frame) {
                                  whole = area_of(frame);
                                  open_hole(frame, Vector3::Zero());
                                  measure(frame);
                                });
  const double first = radii.front().second;
  const auto [start, from] = *std::ranges::find_if(radii, [&](const auto& at) { return at.second > 3 * first; });
  const auto [end, to] = radii.back();
  const std::vector<HoleRadius> exact = exact_growth(thickness, first, to, own.edge);
  Result r = result_of(run, own, (time_at(exact, to) - time_at(exact, from)) / (end - start));
  r.edge = s.edge;
  r.more = {{"of_culick", (to - from) / (end - start) / retraction(thickness)},
            {"first_radius", first / thickness},
            {"last_radius", to / thickness}};
  return r;
}

// The highest point of a rim in the inner part of a square.
double top_of_hole(const Frame& frame, double side) {
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const auto x = positions(frame);
  double top = -side;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    for (const std::uint32_t v : mesh.edges[e])
      if (mesh.on_rim(e) && std::abs(x[v].x()) < 0.4 * side && x[v].y() < 0.45 * side)
        top = std::max(top, x[v].y());
  return top;
}

// A curtain of 60 mm comes out at the speed u of the Weber number ρ h u²/(2 γ), its lower end led at that speed, its
// sides guided. The upper rim of a hole climbs at R' - u: below Weber number 1, but for the rim's own tension [Brown
// 1961]. Value: how fast, over √(2 γ/(ρ h)), in the second half of the run; error: that less what the law says.
Result hole_in_curtain(const Settings& s, double thickness, double weber) {
  constexpr double side = 0.06;
  Settings own = s;
  own.edge = s.edge * side / 2;
  double first = 0;
  const double unit = retraction(thickness), u = std::sqrt(weber) * unit, until = most / unit;
  std::vector<std::pair<double, double>> tops; // over time
  const std::string shape =
      fmt::format("shape = \"rectangle\"\nsize = [{}, {}]\nvelocity = [0, {}, 0]\n", side, side, -u);
  const std::string borders =
      fmt::format("[[hold]]\nregion = \"x_min\"\naxes = \"x\"\n[[hold]]\nregion = \"x_max\"\naxes = \"x\"\n"
                  "[[hold]]\nregion = \"y_min\"\nmotion = {{kind = \"translating\", velocity = [0, {}, 0]}}\n"
                  "[inflow]\nregion = \"y_max\"\nvelocity = [0, {}, 0]\nthickness = {}\n",
                  -u, -u, thickness);
  const Staged run = run_stages(
      film_scene(shape, own, thickness, borders), own, until,
      [&](const Frame& frame) { tops.emplace_back(frame.time, top_of_hole(frame, side)); },
      [&](Frame& frame) {
        const double whole = area_of(frame);
        open_hole(frame, Vector3::Zero());
        first = std::sqrt((whole - area_of(frame)) / pi);
      });
  const auto [start, from] = tops[tops.size() / 2];
  const auto [end, to] = tops.back();
  const double climbed = (to - from) / (end - start) / unit;
  const double radius = from + u * start, later = to + u * end; // of the hole
  const std::vector<HoleRadius> growth = exact_growth(thickness, first, later, own.edge);
  const double exact = (later - radius) / (time_at(growth, later) - time_at(growth, radius)) / unit - std::sqrt(weber);
  Result r = result_of(run, own, climbed);
  r.error = climbed - exact;
  r.edge = s.edge;
  r.more = {{"exact", exact}, {"culick", 1 - std::sqrt(weber)}};
  return r;
}

} // namespace

Result v41(const Settings& s) { return s.set == 1 ? first_holes(s) : number_of_holes(s); }

Result v42(const Settings& s) {
  switch (s.set) {
  case 1:
    return hole_in_film(s, 1e-3);
  case 2:
    return hole_in_film(s, 2e-4);
  case 3:
    return hole_in_curtain(s, 2e-4, 0.8);
  default:
    return hole_in_curtain(s, 2e-4, 1.25);
  }
}

} // namespace sheet::validation
