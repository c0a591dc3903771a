// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include "libsheet/base/error.h"

namespace sheet::render {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
// Distance of a ray's start from the surface that it leaves, in units of the world: some roundings of its coordinates.
constexpr float skip = 1e-6F;
// Solids are drawn smaller by this part of the scene: where liquid lies on one, their faces would else coincide, and a
// ray that leaves the slab would begin inside the solid.
constexpr double inset = 3e-5;

struct Corner {
  float x, y, z, padding; // Embree reads 16 bytes
};

struct PlaneF {
  std::uint32_t id;
  Vec point, normal;
};

} // namespace

struct World::Impl {
  Surface surface;
  Vector3 center = Vector3::Zero();
  double unit = 1; // [m]
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  struct alignas(32) Point { // in one cache line, since rays hit points in any order
    Vec position;
    float thickness; // of the sheet [m]
    Vec normal;
  };
  struct Geometry {
    std::uint32_t id;
    std::vector<Point> points;
    std::vector<Corners> triangles;
  };
  std::vector<Geometry> geometries; // by Embree's number; the sheet's is the first
  std::vector<PlaneF> planes;

  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  [[nodiscard]] Vec to_world(const Vector3& x) const { return ((x - center) / unit).cast<float>(); }

  template <class Place>
  void add(std::uint32_t id, const std::vector<Vector3>& positions, const std::vector<Vec>& normals,
           const std::vector<Corners>& triangles, Place&& place) {
    if (triangles.empty())
      return;
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<Corner*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Corner), positions.size()));
    auto* indices = static_cast<Corners*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Corners), triangles.size()));
    if (corners == nullptr || indices == nullptr)
      fail(ExitCode::io, "not enough memory for the rays' data structure");
    std::vector<Point> points;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vec& x = points.emplace_back(Point{to_world(place(positions[i])), 0, normals[i]}).position;
      corners[i] = {x.x(), x.y(), x.z(), 0};
    }
    std::copy(triangles.begin(), triangles.end(), indices);
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
    geometries.push_back({id, std::move(points), triangles});
  }

  [[nodiscard]] Hit hit_of(const RTCRayHit& r) const {
    Hit hit;
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
      return hit;
    const Geometry& g = geometries[r.hit.geomID];
    const Corners& t = g.triangles[r.hit.primID];
    hit.id = g.id;
    hit.distance = r.ray.tfar;
    hit.face = Vec(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z).stableNormalized();
    hit.u = r.hit.u;
    hit.v = r.hit.v;
    hit.triangle = r.hit.primID;
    const auto between = [&](Vec Point::*value) -> Vec {
      return (1 - hit.u - hit.v) * g.points[t[0]].*value + hit.u * g.points[t[1]].*value +
             hit.v * g.points[t[2]].*value;
    };
    hit.position = between(&Point::position); // rounded less than along the ray
    const Vec n = between(&Point::normal);
    const float length = n.norm();
    hit.normal = length > 1e-3F ? Vec(n / length) : hit.face;
    return hit;
  }

  void planes_nearer(const Ray& ray, float beyond, Hit& hit) const {
    for (const PlaneF& plane : planes) {
      const float slope = ray.direction.dot(plane.normal);
      const float distance = (plane.point - ray.origin).dot(plane.normal) / slope;
      if (!(distance > beyond) || (hit.anything() && distance >= hit.distance) || distance > 1e6F)
        continue;
      hit.id = plane.id;
      hit.plane = true;
      hit.distance = distance;
      hit.face = hit.normal = plane.normal;
      hit.position = ray.origin + distance * ray.direction;
      hit.position -= (hit.position - plane.point).dot(plane.normal) * plane.normal;
    }
  }
};

World::World(const Surface& surface, const std::vector<SolidMesh>& meshes,
             const std::vector<Eigen::Isometry3d>& motions, const std::vector<Plane>& planes, const Box& box)
    : impl_(std::make_unique<Impl>()) {
  impl_->surface = surface;
  impl_->center = box.middle();
  impl_->unit = box.diagonal() > 0 ? box.diagonal() : 1;
  // Not threads=1: that would hold the whole program to one thread as long as the device lives.
  impl_->device = rtcNewDevice("set_affinity=0");
  if (impl_->device == nullptr) {
    const RTCError error = rtcGetDeviceError(nullptr);
    if (error == RTC_ERROR_OUT_OF_MEMORY)
      fail(ExitCode::io, "not enough memory for the rays' data structure");
    fail(ExitCode::internal, "Embree cannot start: error {}", static_cast<int>(error));
  }
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  impl_->add(sheet_id, surface.positions, surface.normals, surface.triangles, [](const Vector3& x) { return x; });
  for (std::size_t p = 0; p < surface.positions.size() && !surface.triangles.empty(); ++p)
    impl_->geometries.front().points[p].thickness = surface.thickness[surface.source_vertex[p]];
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SolidMesh& mesh = meshes[i];
    std::vector<Vec> normals;
    for (const Vec& n : mesh.normals)
      normals.emplace_back(motions[i].linear().cast<float>() * n);
    std::vector<Vector3> drawn = mesh.positions;
    for (std::size_t v = 0; v < drawn.size(); ++v)
      drawn[v] -= inset * impl_->unit * mesh.normals[v].cast<double>();
    impl_->add(first_solid_id + static_cast<std::uint32_t>(mesh.solid), drawn, std::move(normals), mesh.triangles,
               [&](const Vector3& x) -> Vector3 { return motions[i] * x; });
  }
  // One thread builds, so that the tree, and with it who wins a tie between neighbours, is always the same.
  tbb::task_arena(1).execute([&] { rtcCommitScene(impl_->scene); });
  for (const Plane& plane : planes)
    impl_->planes.push_back(
        {plane.id, impl_->to_world(plane.point - inset * impl_->unit * plane.normal), plane.normal.cast<float>()});
}

World::~World() = default;

namespace {

RTCRayHit shoot(RTCScene scene, const Ray& ray, float beyond, float within = infinity) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit r{};
  r.ray.org_x = ray.origin.x();
  r.ray.org_y = ray.origin.y();
  r.ray.org_z = ray.origin.z();
  r.ray.dir_x = ray.direction.x();
  r.ray.dir_y = ray.direction.y();
  r.ray.dir_z = ray.direction.z();
  r.ray.tnear = beyond;
  r.ray.tfar = within;
  r.ray.mask = ~0U;
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &r);
  return r;
}

} // namespace

float World::bare_distance(const Ray& ray) const {
  const RTCRayHit r = shoot(impl_->scene, ray, 0);
  return r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? infinity : r.ray.tfar;
}

Hit World::nearest(const Ray& ray) const { return nearest(ray, 0); }

Hit World::nearest(const Ray& ray, float beyond) const {
  Hit hit = impl_->hit_of(shoot(impl_->scene, ray, beyond));
  impl_->planes_nearer(ray, beyond, hit);
  return hit;
}

Hit World::nearest_sheet(const Ray& ray, float beyond, float within) const {
  const Hit hit = impl_->hit_of(shoot(impl_->scene, ray, beyond, within));
  return hit.id == sheet_id ? hit : Hit{};
}

float World::thickness_at(const Hit& hit) const {
  const Impl::Geometry& sheet = impl_->geometries.front();
  const Corners& t = sheet.triangles[hit.triangle];
  const auto h = [&](std::uint32_t point) { return sheet.points[point].thickness; };
  return (1 - hit.u - hit.v) * h(t[0]) + hit.u * h(t[1]) + hit.v * h(t[2]);
}

const Surface& World::surface() const { return impl_->surface; }
Vec World::to_world(const Vector3& x) const { return impl_->to_world(x); }
Vector3 World::from_world(const Vec& x) const { return impl_->center + impl_->unit * x.cast<double>(); }
double World::unit() const { return impl_->unit; }

Ray leave(const Hit& hit, const Vec& direction) {
  const float side = direction.dot(hit.face) > 0 ? 1.0F : -1.0F;
  const float size = std::max(1.0F, hit.position.cwiseAbs().maxCoeff());
  return {hit.position + side * skip * size * hit.face, direction};
}

} // namespace sheet::render
