// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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
  bool lets_light_in;
};

} // namespace

struct World::Impl {
  Surface surface;
  Vector3 center = Vector3::Zero();
  double unit = 1; // [m]
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  struct alignas(32) Point { // in one cache line, since rays hit points in any order
    Vec position, normal;
  };
  struct Geometry {
    std::uint32_t id;
    std::vector<Point> points;
    std::vector<Corners> triangles;

    // Where a face is hit, and the normal there.
    void place(Hit& hit) const {
      const Corners& t = triangles[hit.triangle];
      const auto between = [&](Vec Point::*value) -> Vec {
        return (1 - hit.u - hit.v) * points[t[0]].*value + hit.u * points[t[1]].*value + hit.v * points[t[2]].*value;
      };
      hit.position = between(&Point::position); // rounded less than along the ray
      const Vec n = between(&Point::normal);
      const float length = n.norm();
      hit.normal = length > 1e-3F ? Vec(n / length) : hit.face;
    }
  };
  std::vector<Geometry> geometries;            // by Embree's number; the sheet's is the first
  std::vector<std::array<float, 3>> thickness; // at the corners of its triangles [m]: rays go through many
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
      const Vec& x = points.emplace_back(Point{to_world(place(positions[i])), normals[i]}).position;
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
    hit.id = g.id;
    hit.distance = r.ray.tfar;
    hit.face = Vec(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z).stableNormalized();
    hit.u = r.hit.u;
    hit.v = r.hit.v;
    hit.triangle = r.hit.primID;
    hit.part = r.hit.geomID;
    g.place(hit);
    return hit;
  }

  void planes_nearer(const Ray& ray, float beyond, Hit& hit, Looks looks) const {
    for (const PlaneF& plane : planes) {
      if (plane.lets_light_in && looks != Looks::straight)
        continue;
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
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);

  impl_->add(sheet_id, surface.positions, surface.normals, surface.triangles, [](const Vector3& x) { return x; });
  for (const Corners& t : surface.triangles) {
    const auto h = [&](std::size_t corner) { return surface.thickness[surface.source_vertex[t[corner]]]; };
    impl_->thickness.push_back({h(0), h(1), h(2)});
  }
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
    impl_->planes.push_back({plane.id, impl_->to_world(plane.point - inset * impl_->unit * plane.normal),
                             plane.normal.cast<float>(), plane.lets_light_in});
}

World::~World() = default;

namespace {

// Embree takes no others.
bool may_be_shot(const Ray& ray, float beyond, float within) {
  constexpr float farthest = 1.8e18F; // Embree's FLT_LARGE is 1.844e18
  return (ray.origin.array().abs() < farthest).all() && (ray.direction.array().abs() < farthest).all() &&
         !std::isnan(beyond) && !std::isnan(within);
}

RTCRayHit shoot(RTCScene scene, RTCIntersectContext& context, const Ray& ray, float beyond, float within) {
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
  if (may_be_shot(ray, beyond, within)) // what starts so far away meets nothing
    rtcIntersect1(scene, &context, &r);
  return r;
}

RTCRayHit shoot(RTCScene scene, const Ray& ray, float beyond, float within = infinity) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return shoot(scene, context, ray, beyond, within);
}

// The nearest faces that a traversal has come to, for Embree's filter of hits.
struct Gathering {
  RTCIntersectContext context{}; // first: Embree hands on its address
  std::span<Face> found;
  std::size_t count = 0;

  explicit Gathering(std::span<Face> room) : found(room) {
    rtcInitIntersectContext(&context);
    context.filter = [](const RTCFilterFunctionNArguments* a) {
      auto& ray = *reinterpret_cast<RTCRay*>(a->ray);
      // A hit that is taken ends what Embree looks at; others do not.
      a->valid[0] = reinterpret_cast<Gathering*>(a->context)->keep(ray, *reinterpret_cast<RTCHit*>(a->hit)) ? -1 : 0;
    };
  }

  // Whether there is no room for any farther than the last; that is then where the ray ends.
  bool keep(RTCRay& ray, const RTCHit& hit) {
    if (count == found.size() && ray.tfar >= found.back().distance)
      return false;
    std::size_t i = count < found.size() ? count++ : count - 1;
    for (; i > 0 && found[i - 1].distance > ray.tfar; --i)
      found[i] = found[i - 1];
    Face& face = found[i];
    face.part = hit.geomID;
    face.distance = ray.tfar;
    face.face = {hit.Ng_x, hit.Ng_y, hit.Ng_z};
    face.u = hit.u;
    face.v = hit.v;
    face.triangle = hit.primID;
    if (count < found.size())
      return false;
    ray.tfar = found.back().distance;
    return true;
  }
};

} // namespace

float World::bare_distance(const Ray& ray) const {
  const RTCRayHit r = shoot(impl_->scene, ray, 0);
  return r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? infinity : r.ray.tfar;
}

Hit World::nearest(const Ray& ray) const { return nearest(ray, 0); }

Hit World::nearest(const Ray& ray, float beyond) const {
  Hit hit = impl_->hit_of(shoot(impl_->scene, ray, beyond));
  impl_->planes_nearer(ray, beyond, hit, Looks::straight);
  return hit;
}

Hit World::nearest_sheet(const Ray& ray, float beyond, float within) const {
  const Hit hit = impl_->hit_of(shoot(impl_->scene, ray, beyond, within));
  return hit.id == sheet_id ? hit : Hit{};
}

std::size_t World::faces(const Ray& ray, float beyond, float within, std::span<Face> found) const {
  Gathering gathering(found);
  shoot(impl_->scene, gathering.context, ray, beyond, within);
  for (Face& face : found.first(gathering.count)) {
    face.id = impl_->geometries[face.part].id;
    face.face.stableNormalize();
  }
  return gathering.count;
}

Hit World::nearest_plane(const Ray& ray, Looks looks) const {
  Hit hit;
  impl_->planes_nearer(ray, 0, hit, looks);
  return hit;
}

Hit World::hit_of(const Face& face) const {
  Hit hit{face, Vec::Zero(), Vec::Zero()};
  impl_->geometries[face.part].place(hit);
  return hit;
}

float World::thickness_at(const Face& hit) const {
  const std::array<float, 3>& h = impl_->thickness[hit.triangle];
  return (1 - hit.u - hit.v) * h[0] + hit.u * h[1] + hit.v * h[2];
}

const Surface& World::surface() const { return impl_->surface; }
Vec World::to_world(const Vector3& x) const { return impl_->to_world(x); }
Vector3 World::from_world(const Vec& x) const { return impl_->center + impl_->unit * x.cast<double>(); }
double World::unit() const { return impl_->unit; }

namespace {

// How far from a surface rays start there.
float step_off(const Vec& position) { return skip * std::max(1.0F, position.cwiseAbs().maxCoeff()); }

Face counted_from(float distance, Face face) {
  face.distance -= distance;
  return face;
}

} // namespace

FacesAhead::FacesAhead(const World& world, const Ray& ray, Looks looks)
    : world_(&world), ray_(ray), plane_(world.nearest_plane(ray, looks)) {}

// Whether a ray that has left the last face would not hit it, since it starts beside that (leave()).
bool FacesAhead::is_before(const Face& face) const {
  if (!last_.anything())
    return false;
  const float off = step_off(ray_.origin + last_.distance * ray_.direction), cosine = ray_.direction.dot(face.face);
  const float side = ray_.direction.dot(last_.face) > 0 ? off : -off;
  return !(face.distance - last_.distance > side * last_.face.dot(face.face) / cosine);
}

bool FacesAhead::look_on(std::uint64_t& rays) {
  if (count_ < found_.size())
    return false;
  ++rays;
  const float beyond = last_.anything() ? std::nextafter(found_.back().distance, infinity) : 0;
  count_ = world_->faces(ray_, beyond, plane_.anything() ? plane_.distance : infinity, found_);
  at_ = 0;
  return count_ > 0;
}

Face FacesAhead::next(std::uint64_t& rays) {
  while (at_ < count_ || look_on(rays))
    if (const Face& face = found_[at_++]; !is_before(face))
      return counted_from(std::exchange(last_, face).distance, face);
  return counted_from(last_.distance, plane_);
}

Hit FacesAhead::hit(const Face& told) const {
  Hit hit = told.plane || !told.anything() ? plane_ : world_->hit_of(told);
  hit.distance = told.distance;
  return hit;
}

Ray leave(const Hit& hit, const Vec& direction) {
  const float side = direction.dot(hit.face) > 0 ? 1.0F : -1.0F;
  return {hit.position + side * step_off(hit.position) * hit.face, direction};
}

} // namespace sheet::render
