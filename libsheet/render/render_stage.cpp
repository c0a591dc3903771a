// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/render_stage.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <span>

#include "libsheet/base/error.h"
#include "libsheet/base/file_roles.h"
#include "libsheet/base/files.h"
#include "libsheet/base/frame_files.h"
#include "libsheet/base/log.h"
#include "libsheet/quantities/sheet_kinds.h"
#include "libsheet/render/denoised.h"
#include "libsheet/render/display.h"
#include "libsheet/render/drops.h"
#include "libsheet/render/framing.h"
#include "libsheet/render/motion.h"
#include "libsheet/render/path_tracer.h"
#include "libsheet/render/picture_file.h"
#include "libsheet/render/scale_bar.h"
#include "libsheet/render/sights.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/frame_scene.h"

namespace sheet::render {
namespace {

constexpr double margin = 0.04;                 // of the picture, around the subject
constexpr double largest = 1e30;                // subject, far from where single precision ends [m]
constexpr double unknown_growth = 0.25;         // of a subject of which only the first frame is known
constexpr double farthest = 1e9;                // eye, in sizes of the subject
constexpr double thinnest = 1e-4;               // of the subject: a sheet below it is drawn as its mid-surface
constexpr int ring_size = 24;                   // of directions in which what a turntable shows is measured
constexpr int most_times = 32;                  // at which what moves is drawn while the shutter is open
constexpr std::size_t most_to_smooth = 200'000; // triangles of the middle surface
constexpr double flat_enough = 0.7;             // pixels that the chords of its sharpest edges may be off

void check(const RenderOptions& o) {
  const CameraOptions& c = o.camera;
  if (!o.y4m && !o.ppm && o.output.empty())
    fail(ExitCode::usage, "give -o FILE, such as -o frames/%04d.png, or --y4m and pipe it on");
  if ((o.y4m ? 1 : 0) + (o.ppm ? 1 : 0) + (o.output.empty() ? 0 : 1) > 1)
    fail(ExitCode::usage, "-o, --y4m and --ppm exclude each other");
  if (o.transparent && o.output.empty())
    fail(ExitCode::usage, "--transparent: {} has no alpha: write pictures, such as -o frames/%04d.png",
         o.y4m ? "a y4m video" : "PPM");
  if (o.turntable < 0 || o.turntable == 1)
    fail(ExitCode::usage, "--turntable: {} pictures do not go round: give 2 or more, or 0", o.turntable);
  if (o.denoise && o.draw.noise > 0)
    fail(ExitCode::usage, "--denoise and --noise exclude each other");
  if (!o.output.empty() && !o.output.ends_with(".png") && !o.output.ends_with(".exr"))
    fail(ExitCode::usage, "-o {}: the name must end in .png or .exr", o.output);
  if (!(c.field_of_view >= 1 && c.field_of_view <= 160))
    fail(ExitCode::usage, "--fov: {} is not between 1 and 160 degrees", c.field_of_view);
  if (c.elevation && !(std::abs(*c.elevation) <= 90))
    fail(ExitCode::usage, "--elevation: {} is not between -90 and 90 degrees", *c.elevation);
  if (c.eye && c.target && !((*c.eye - *c.target).norm() > 0))
    fail(ExitCode::usage, "--eye and --target are the same point: the camera has no direction");
  if (!(o.frames_per_second > 0 && o.frames_per_second <= 1000))
    fail(ExitCode::usage, "--fps: {} is not above 0 and at most 1000", o.frames_per_second);
  if (o.index && !(*o.index > 1 && *o.index <= 4))
    fail(ExitCode::usage, "--index: {} is not above 1 and at most 4", *o.index);
  if (!(o.optical_scale > 0))
    fail(ExitCode::usage, "--optical-scale: {} is not positive", o.optical_scale);
  for (const auto& [name, value] :
       {std::pair("--roughness", std::optional(o.roughness)), std::pair("--ground-gloss", o.ground_gloss),
        std::pair("--solid-gloss", o.solid_gloss)})
    if (value && !(*value >= 0 && *value <= 1))
      fail(ExitCode::usage, "{}: {} is not between 0 and 1", name, *value);
  std::vector<Colour> colours = o.solid_colours;
  if (o.ground_colour)
    colours.push_back(*o.ground_colour);
  for (const Colour& r : colours)
    if (!(r.maxCoeff() <= 1))
      fail(ExitCode::usage, "--ground-colour, --solid-colour: {},{},{}: nothing reflects more than 1", r[0], r[1],
           r[2]);
  if (!(o.aperture >= 0 && o.shutter >= 0))
    fail(ExitCode::usage, "--aperture and --shutter must not be negative");
  if (o.shutter > 0 && o.draw.noise > 0)
    fail(ExitCode::usage, "--shutter and --noise exclude each other");
  if (!(o.environment_strength > 0))
    fail(ExitCode::usage, "--environment-strength: {} is not positive", o.environment_strength);
  if (o.environment.empty() && (o.environment_turn != 0 || o.environment_strength != 1))
    fail(ExitCode::usage, "--environment-turn and --environment-strength are of the image that --environment names");
  if (!(std::abs(o.exposure) <= 30))
    fail(ExitCode::usage, "--exposure: {} is not between -30 and 30 stops", o.exposure);
}

// Those that the liquids of a scene are drawn as, which may be fewer than the options name.
std::vector<Liquid> drawn_liquids(const RenderOptions& o, const Scene* scene) {
  const std::size_t there = scene != nullptr ? liquids_of(*scene).size() : 1;
  std::vector<Liquid> liquids;
  for (const std::size_t number : std::span(o.liquids).first(std::min(there, o.liquids.size()))) {
    Liquid liquid = preset(number);
    if (o.index)
      liquid.index = static_cast<float>(*o.index);
    liquid.roughness = static_cast<float>(o.roughness);
    const auto scale = static_cast<float>(o.optical_scale);
    liquid.absorption = scale * o.absorption.value_or(liquid.absorption);
    liquid.scattering = scale * o.scattering.value_or(liquid.scattering);
    liquids.push_back(liquid);
  }
  return liquids;
}

// Reflectances of solids, in turn.
Colour solid_colour(std::size_t i) {
  static const Colour colours[] = {
      {0.66F, 0.63F, 0.58F}, {0.45F, 0.52F, 0.58F}, {0.58F, 0.50F, 0.42F}, {0.50F, 0.55F, 0.48F}};
  return colours[i % 4];
}

// Reflectances.
const Colour bath_colour{0.24F, 0.34F, 0.42F};
const Colour dark_ground{0.10F, 0.10F, 0.11F};

// Before a pale ground one sees next to nothing of a liquid that takes away so little light.
bool is_clear(const Liquid& liquid, const formats::Frame& frame) {
  constexpr float visible = 0.25F; // of the light, about
  const auto x = positions(frame);
  double area = 0, volume = 0;
  for (const Corners& c : triangles(frame))
    area += 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm();
  for (const double v : volumes(frame))
    volume += v;
  return area > 0 && (liquid.absorption + liquid.scattering).maxCoeff() * static_cast<float>(volume / area) < visible;
}

} // namespace

struct RenderStage::Impl {
  RenderOptions options;
  std::optional<FrameFiles> files;
  std::optional<OutputFile> video;
  std::optional<Image> surroundings;

  FrameScene scenes;
  const Scene* scene = nullptr; // the frame's, if it has one
  std::vector<SolidMesh> meshes;

  std::unique_ptr<SheetKinds> sheets; // of the scene, of the look `sheet`
  std::optional<Field> sheet_field;   // likewise

  Vector3 up = Vector3::UnitY();       // in the first scene
  std::optional<Survey> survey;        // from where the camera may look
  std::optional<Sights> sights;        // from each of these places
  std::vector<std::size_t> enclosing;  // solids that are left out, by their number in the scene
  std::vector<double> elevations;      // of them
  std::map<double, std::size_t> rings; // by elevation, the first of the views all round (add_rings)
  bool surveyed = false;               // by survey()
  struct Fixed {                       // for all pictures
    Box subject;
    Camera camera;
    Lighting lighting;
    Scale scale;
    Vector3 pivot;         // of a turntable
    bool light_from_right; // of the studio
    std::optional<Plane> ground;
    bool dark = false; // the ground
  };
  std::optional<Fixed> fixed;
  std::optional<Camera> first_camera;
  bool told_out_of_sight = false, told_empty = false, told_noisy = false, told_liquids = false;
  std::uint64_t pictures = 0;

  explicit Impl(RenderOptions o) : options(std::move(o)) {
    check(options);
    options.draw.samples += options.draw.samples & 1;
    options.draw.exposure = static_cast<float>(std::exp2(options.exposure));
    if (options.output.empty())
      video.emplace("-", OutputFile::Content::binary);
    else
      files.emplace(options.output, "--frames");
    if (!options.environment.empty())
      surroundings = environment();
    if (files && options.turntable > 0 && !files->names().has_number())
      fail(ExitCode::usage, "-o {} names one file and --turntable makes {}: number them, as in turn_%04d{}",
           options.output, options.turntable, std::filesystem::path(options.output).extension().string());
    if (files) { // refused before anything is drawn
      claim_file(files->names().of(0), FileRole::output);
      release_file(files->names().of(0), FileRole::output);
    }
  }

  [[nodiscard]] Image environment() const {
    Image image = read_picture(options.environment);
    for (Colour& c : image.pixels)
      c *= static_cast<float>(options.environment_strength);
    return image;
  }

  void read_scene_of(const formats::Frame& frame) {
    scene = scenes.find(frame);
    if (scenes.changed() && scene != nullptr && options.look.has_scale() && options.look.field->needs == Needs::sheets)
      name_sheets();
    if (scenes.changed())
      meshes = draws_solids() ? make_solids(*scene) : std::vector<SolidMesh>{};
    leave_out_enclosing();
  }

  // In the key of the look `sheet`.
  void name_sheets() {
    const Field& field = field_named("sheet");
    sheets = std::make_unique<SheetKinds>(sheet_names(*scene));
    sheet_field.emplace(Field{field.name, field.caption, field.unit, field.where, field.get, sheets->palette(),
                              field.in_figures, field.needs});
    options.look.field = &*sheet_field;
  }

  [[nodiscard]] bool draws_solids() const { return scene != nullptr && options.solids != DrawnSolids::none; }

  void leave_out_enclosing() {
    std::erase_if(meshes, [&](const SolidMesh& mesh) { return std::ranges::count(enclosing, mesh.solid) > 0; });
  }

  // Around the subject; what is written on the picture stands beside it.
  [[nodiscard]] Margins margins() const {
    const int width = options.draw.width, height = options.draw.height;
    Margins m{margin, margin, margin, margin};
    if (options.look.has_scale() && has_room_for_scale(width, height))
      m.right = std::max(margin, scale_width(width, height));
    if (!options.look.is_material())
      m.bottom = std::max(margin, clock_height(width, height));
    return m;
  }

  // Of false colours.
  [[nodiscard]] Scale scale() const {
    if (options.range || !options.look.has_scale())
      return options.range.value_or(Scale{0, 1});
    return widened(survey->scale(), *options.look.field);
  }

  [[nodiscard]] std::vector<Vector3> plane_normals(double time) const {
    std::vector<Vector3> normals;
    for (const Plane& plane : draws_solids() ? make_planes(*scene, time) : std::vector<Plane>{})
      normals.push_back(plane.normal);
    return normals;
  }

  // From which the camera may look, the best first; where the user says from where, only that.
  [[nodiscard]] std::vector<CameraOptions> views_before(std::span<const Vector3> normals) const {
    std::vector<CameraOptions> views;
    for (const ViewAngles& view : views_before_planes(options.camera, up, normals)) {
      CameraOptions& camera = views.emplace_back(options.camera);
      camera.azimuth = view.azimuth;
      camera.elevation = view.elevation;
      if (options.camera.eye)
        break;
    }
    return views;
  }

  void look_at(const formats::Frame& frame) {
    read_scene_of(frame);
    if (!survey) {
      up = up_of(scene);
      const double aspect = static_cast<double>(options.draw.width) / options.draw.height;
      std::vector<ViewFit> fits;
      std::vector<Vector3> toward;
      const std::vector<Vector3> normals = plane_normals(frame.time);
      for (const CameraOptions& view : views_before(normals)) {
        fits.emplace_back(view, up, aspect, margins());
        toward.push_back(direction_to_camera(view, up));
        elevations.push_back(view.elevation.value_or(usual_view.elevation));
      }
      add_rings(aspect, fits);
      survey.emplace(fits);
      sights.emplace(options.camera.eye ? std::vector<Vector3>{} : toward, normals);
    }
    survey->add(frame, scene, meshes, options.look);
    sights->add(frame, scene, meshes);
  }

  // For a turntable, behind the views: of each of their elevations, as many all round.
  void add_rings(double aspect, std::vector<ViewFit>& fits) {
    for (const double elevation : elevations)
      if (options.turntable > 0 && rings.try_emplace(elevation, fits.size()).second)
        for (int i = 0; i < ring_size; ++i) {
          CameraOptions view = options.camera;
          view.azimuth = 360.0 * i / ring_size;
          view.elevation = elevation;
          fits.emplace_back(view, up, aspect, margins());
        }
  }

  // The first camera, of that view of the survey.
  [[nodiscard]] Camera camera_of(const Extent& extent, std::size_t view, const Vector3& middle, double growth) const {
    const Camera camera = extent.views[view].camera(middle, growth);
    if (options.turntable == 0 || options.camera.eye)
      return camera;
    const Vector3 target = options.camera.target.value_or(middle), toward = -camera.axis().cast<double>();
    double distance = 0;
    for (std::size_t i = 0; i < ring_size; ++i)
      distance = std::max(distance, extent.views[rings.at(elevations[view]) + i].distance(target, middle, growth));
    return {target + distance * toward, target, up, options.camera.field_of_view, camera.aspect()};
  }

  // Where the next picture is taken from, and its light.
  void turn() {
    if (options.turntable == 0)
      return;
    const double part = static_cast<double>(pictures) / static_cast<double>(options.turntable);
    fixed->camera = first_camera->turned(fixed->pivot, up, 2 * std::numbers::pi * (part - std::floor(part)));
    if (!surroundings)
      fixed->lighting = Lighting::studio(-fixed->camera.axis(), up.cast<float>(), fixed->light_from_right);
  }

  void warn_of_walls(double time) const {
    constexpr double upright = 0.1; // the sine of its angle with the upward axis, at least
    if (options.turntable > 0 && draws_solids())
      for (const Plane& plane : make_planes(*scene, time))
        if (plane.normal.cross(up).norm() > upright)
          log::warning("[[solid]] {} is an upright plane: --turntable goes behind it too (--solids none leaves it out)",
                       plane.id - first_solid_id);
  }

  // The light from the left would leave them dark.
  [[nodiscard]] bool walls_face_right(const Camera& camera, double time) const {
    double facing = 0;
    for (const Vector3& normal : plane_normals(time))
      if (std::abs(normal.dot(up)) < wall)
        facing += normal.dot(camera.right().cast<double>());
    return facing > 0.1;
  }

  void leave_out_what_encloses() {
    if (options.solids != DrawnSolids::not_enclosing)
      return;
    enclosing = sights->enclosing(survey->has_solids_in_picture());
    for (const std::size_t solid : enclosing)
      log::warning("[[solid]] {} hides the sheet from all sides and is not drawn (--solids all draws it)", solid);
    leave_out_enclosing();
  }

  // Decides what stays the same in all pictures.
  void fix(const formats::Frame& frame) {
    if (!surveyed)
      look_at(frame);
    const Extent extent = survey->subject();
    Box subject = extent.box;
    if (subject.empty())
      fail(ExitCode::bad_input,
           "there is nothing to see: the sheet has no triangles and the scene no solids with an end");
    if (!(subject.diagonal() < largest))
      fail(ExitCode::bad_input,
           "what there is to see measures {:.3g} m across, more than {:g} m: the sheet has blown up, or a triangle has "
           "next to no area, so that it is thick without bound (sheet-check tells which)",
           subject.diagonal(), largest);
    if (options.camera.eye && !((options.camera.target.value_or(subject.middle()) - *options.camera.eye).norm() > 0))
      fail(ExitCode::usage, "--eye is the middle of what there is to see: give --target too");
    const double growth = surveyed ? 0 : unknown_growth;
    const Vector3 reach = (0.5 + growth) * (subject.high - subject.low), middle = subject.middle();
    subject = {middle - reach, middle + reach};
    leave_out_what_encloses();
    Camera camera = camera_of(extent, sights->best(enclosing), middle, 2 * growth);
    warn_of_walls(frame.time);
    check_reach(camera, extent.box);
    if (options.aperture > 0 && options.look.is_material())
      camera.set_lens({options.aperture / 2, std::min(focus_distance(camera, middle), farthest * subject.diagonal())});
    const bool from_right = walls_face_right(camera, frame.time);
    const Vec toward = -camera.axis(), upward = up.cast<float>();
    Fixed f{subject,
            camera,
            surroundings ? Lighting::surroundings(*surroundings, toward, upward,
                                                  static_cast<float>(options.environment_turn) * float_pi / 180)
                         : Lighting::studio(toward, upward, from_right),
            scale(),
            options.camera.target.value_or(middle),
            from_right,
            std::nullopt};
    if (const BathLiquid* bath = bath_in_view(); bath != nullptr)
      f.ground = bath_surface(bath->level, subject, up, has_shore(*scene));
    else if (options.ground && options.look.is_material() && (!scene || make_planes(*scene, frame.time).empty()))
      f.ground = ground_below(subject, up);
    f.dark = std::ranges::all_of(drawn_liquids(options, scene), [&](const Liquid& l) { return is_clear(l, frame); });
    fixed.emplace(std::move(f));
    first_camera = camera;
    const Vector3 eye = camera.eye(), axis = camera.axis().cast<double>(),
                  target = options.camera.target.value_or(eye + (middle - eye).dot(axis) * axis);
    log::detail("camera: --eye {:.6g},{:.6g},{:.6g} --target {:.6g},{:.6g},{:.6g}", eye.x(), eye.y(), eye.z(),
                target.x(), target.y(), target.z());
    if (options.look.has_scale())
      log::detail("scale: {:.9g} to {:.9g}", fixed->scale.low, fixed->scale.high);
  }

  // Rays go in single precision: nothing may be so far away, or so wide, that they end.
  void check_reach(const Camera& camera, const Box& subject) const {
    const double reach = farthest * subject.diagonal();
    if (const double away = (subject.middle() - camera.eye()).norm(); !(away < reach))
      fail(ExitCode::usage,
           "--{} is {:.3g} m away from what there is to see, which measures {:.3g} m: nothing of it would be seen",
           options.camera.eye ? "eye" : "target", away, subject.diagonal());
    if (!(options.aperture < reach))
      fail(ExitCode::usage,
           "--aperture: a lens of {:.3g} m before what measures {:.3g} m: nothing of it would be sharp",
           options.aperture, subject.diagonal());
  }

  [[nodiscard]] double focus_distance(const Camera& camera, const Vector3& middle) const {
    const Vector3 sharp = options.focus.value_or(options.camera.target.value_or(middle));
    const double distance = (sharp - camera.eye()).dot(camera.axis().cast<double>());
    if (!(distance > 0))
      fail(ExitCode::usage, "--focus {},{},{} lies behind the camera", sharp.x(), sharp.y(), sharp.z());
    return distance;
  }

  [[nodiscard]] const BathLiquid* bath_in_view() const {
    const bool drawn = scene != nullptr && scene->environment.bath && options.look.is_material();
    return drawn ? &*scene->environment.bath : nullptr;
  }

  void warn_if_out_of_sight(const formats::Frame& frame) {
    if (frame.triangles == 0) {
      if (!told_empty)
        log::warning("the sheet of the frame at {} s has no triangles: only what is around it is drawn", frame.time);
      told_empty = true;
      return;
    }
    if (told_out_of_sight)
      return;
    for (const Vector3& x : positions(frame))
      if (fixed->camera.sees(x))
        return;
    told_out_of_sight = true;
    log::warning("the sheet of the frame at {} s is out of the picture: {}", frame.time,
                 options.camera.eye ? "--eye and --target look elsewhere"
                 : surveyed
                     ? "it is far below all solids, or the camera stands as for other frames; --frames draws "
                       "earlier ones, --eye and --target look at this one, and an [[outflow]] in the scene takes "
                       "up what falls for ever"
                     : "give --eye and --target, or read the stream from a file, so that all frames are known");
  }

  void warn_of_unknown_liquids(const formats::Frame& frame) {
    if (told_liquids || scene == nullptr || options.liquids.size() < 2 || !options.look.is_material() ||
        tells_liquids(*scene, frame))
      return;
    told_liquids = true;
    log::warning(
        "the frame at {} s does not say which triangle is of which of its scene's liquids: all is drawn as the "
        "first one ({})",
        frame.time, scene::keep_liquid);
  }

  [[nodiscard]] Surroundings surroundings_of_liquid() const {
    Surroundings around;
    if (options.ground_colour || fixed->dark)
      around.ground = options.ground_colour.value_or(dark_ground);
    for (std::size_t i = 0; scene && i < scene->solids.size(); ++i) {
      const auto& colours = options.solid_colours;
      around.solids.push_back(std::holds_alternative<scene::HalfSpace>(scene->solids[i].shape) ? around.ground
                              : colours.empty()                                                ? solid_colour(i)
                                                : colours[i % colours.size()]);
    }
    if (bath_in_view() != nullptr && !options.ground_colour)
      around.ground = bath_colour;
    const auto gloss = [](const std::optional<double>& r) {
      return r ? std::optional(static_cast<float>(*r)) : std::optional<float>();
    };
    around.ground_gloss = gloss(options.ground_gloss);
    around.solid_gloss = gloss(options.solid_gloss);
    around.cut_out = options.transparent;
    return around;
  }

  [[nodiscard]] Picture picture_of(const formats::Frame& frame, const World& world, const DrawOptions& how,
                                   const Progress& progress) const {
    if (!options.look.is_material())
      return false_colours_of(frame, world, how, progress);
    const PathTracer tracer = tracer_of(world);
    if (options.denoise)
      return draw_denoised(world, fixed->camera, tracer, how, progress);
    Coverage coverage;
    if (options.transparent)
      coverage = [&](const Ray& ray, std::uint64_t& rays) { return tracer.coverage(ray, rays); };
    return render::draw(
        world, fixed->camera,
        [&](const Ray& ray, Sampler& sampler, std::uint64_t& rays) {
          return tracer.radiance(ray, sampler, rays).sum();
        },
        how, progress, coverage);
  }

  [[nodiscard]] Picture false_colours_of(const formats::Frame& frame, const World& world, const DrawOptions& how,
                                         const Progress& progress) const {
    const Field* field = options.look.field;
    const Shader shader = field != nullptr ? field_shader(world, *field, values_of(frame, *field), fixed->scale)
                                           : wireframe_shader(world, fixed->camera.pixel_angle(how.height));
    Picture picture = render::draw(world, fixed->camera, shader, how, progress,
                                   options.transparent ? covers_paper(world) : Coverage());
    for (std::size_t i = 0; i < picture.alpha.size(); ++i)
      picture.light.pixels[i] -= how.exposure * (1 - picture.alpha[i]) * paper();
    return picture;
  }

  [[nodiscard]] PathTracer tracer_of(const World& world) const {
    return {world, fixed->lighting, drawn_liquids(options, scene), surroundings_of_liquid(),
            options.layers ? Body() : Body(world)};
  }

  // Of what the pictures are about, the size of a pixel where it is nearest to the camera [m].
  [[nodiscard]] double pixel_of_nearest() const {
    const Vector3& eye = fixed->camera.eye();
    const Vector3 nearest = eye.cwiseMax(fixed->subject.low).cwiseMin(fixed->subject.high);
    return fixed->camera.pixel_angle(options.draw.height) * (nearest - eye).norm();
  }

  // What there is to see at the time of a frame with balls (drops.h).
  [[nodiscard]] std::unique_ptr<World> world_of(const formats::Frame& frame, double time) const {
    std::vector<Eigen::Isometry3d> motions;
    for (const SolidMesh& mesh : meshes)
      motions.push_back(motion_of(scene->solids[mesh.solid], time));
    std::vector<Plane> planes = draws_solids() ? make_planes(*scene, time) : std::vector<Plane>{};
    if (fixed->ground)
      planes.push_back(*fixed->ground);
    const Middle middle = own_middle(frame);
    const bool smooth = options.look.is_material() && !options.facets;
    const auto own_volumes = volumes(frame).first(own_parts(frame).triangles);
    const PartingLimits until{most_to_smooth, flat_enough * pixel_of_nearest()};
    Surface surface =
        make_surface(smooth ? smoothed(middle, own_volumes, until) : middle, thinnest * fixed->subject.diagonal());
    add_balls(frame, surface);
    if (scene != nullptr && options.liquids.size() > 1 && tells_liquids(*scene, frame))
      if (const FrameLiquids liquids(*scene, frame); liquids.several())
        for (const std::uint32_t t : surface.source_triangle)
          surface.liquids.push_back(liquids.number(t));
    const bool bodies = options.look.is_material() && !options.layers;
    return bodies ? world_of_bodies(surface, meshes, motions, planes, fixed->subject)
                  : std::make_unique<World>(surface, meshes, motions, planes, fixed->subject);
  }

  // While the shutter is open, at times so near to each other that what moves moves by about a pixel between.
  [[nodiscard]] Picture picture_while_open(const formats::Frame& frame, const Progress& progress) const {
    const double pixels = pixels_moved(frame, scene, meshes, options.shutter, fixed->camera, options.draw.height);
    const int times = std::clamp(static_cast<int>(std::ceil(pixels)), 1, most_times);
    DrawOptions how = options.draw;
    how.samples = std::max(2, how.samples / times & ~1);
    std::vector<Picture> parts;
    for (int i = 0; i < times; ++i) {
      const double later = options.shutter * ((i + 0.5) / times - 0.5);
      const formats::Frame then = moved(frame, later);
      how.first_sample = i * how.samples;
      parts.push_back(picture_of(then, *world_of(then, frame.time + later), how, [&](double part) {
        if (progress)
          progress((i + part) / times);
      }));
    }
    return mean_of(parts);
  }

  [[nodiscard]] Picture picture_of(const formats::Frame& frame, const Progress& progress) const {
    if (options.shutter > 0 && options.look.is_material())
      return picture_while_open(frame, progress);
    return picture_of(frame, *world_of(frame, frame.time), options.draw, progress);
  }

  void add_layers(const formats::Frame& frame, const World& world, Picture& picture) const {
    LayerSources sources;
    sources.velocity = [&](const Hit& hit) { return velocity_at(frame, scene, world, hit); };
    sources.albedo = [](const Hit&, const Vec&) -> Colour { return Colour::Zero(); };
    if (!options.look.is_material()) {
      fill_layers(world, fixed->camera, sources, picture);
      return;
    }
    const PathTracer tracer = tracer_of(world);
    sources.albedo = [&](const Hit& hit, const Vec& direction) { return tracer.reflectance(hit, direction); };
    fill_layers(world, fixed->camera, sources, picture);
  }

  void write(Picture& picture, const formats::Frame& frame, const std::string& file) {
    if (file.ends_with(".exr")) {
      add_layers(frame, *world_of(frame, frame.time), picture);
      files->write(encode_exr(picture));
      return;
    }
    const bool photo = options.look.is_material();
    Bitmap bitmap = to_bitmap(picture, photo ? options.tone : Tone::linear);
    if (!photo)
      draw_scale(bitmap, fixed->scale, options.look, frame.time);
    if (files) {
      files->write(encode_png(bitmap));
    } else if (options.ppm) {
      video->write(encode_ppm(bitmap));
    } else {
      if (pictures == 0)
        video->write(y4m_header(bitmap.width, bitmap.height, options.frames_per_second));
      video->write(encode_y4m(bitmap));
    }
  }

  PictureReport draw(const formats::Frame& frame, std::uint64_t index, const Progress& progress) {
    const std::string file = files ? files->next(options.turntable > 0 ? pictures : index) : "";
    read_scene_of(frame);
    if (!fixed)
      fix(frame);
    turn();
    warn_if_out_of_sight(frame);
    warn_of_unknown_liquids(frame);
    const formats::Frame seen = with_balls(frame);
    Picture picture = picture_of(seen, progress);
    if (options.draw.noise > 0 && picture.worst_noise > options.draw.noise && !told_noisy) {
      log::warning("the noise of the frame at {} s stays above {:g} in places, at most {:.2g}: give more --samples",
                   frame.time, options.draw.noise, picture.worst_noise);
      told_noisy = true;
    }
    write(picture, seen, file);
    ++pictures;
    return {picture.noise, picture.worst_noise, picture.samples, picture.rays, file};
  }
};

RenderStage::RenderStage(RenderOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
RenderStage::~RenderStage() = default;

void RenderStage::survey(const formats::Frame& frame) {
  impl_->look_at(frame);
  impl_->surveyed = true;
}

PictureReport RenderStage::draw(const formats::Frame& frame, std::uint64_t index, const Progress& progress) {
  return impl_->draw(frame, index, progress);
}

void RenderStage::finish() {
  if (impl_->files)
    impl_->files->finish();
  if (impl_->video)
    impl_->video->close();
}

} // namespace sheet::render
