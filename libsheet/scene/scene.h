// SPDX-License-Identifier: GPL-3.0-or-later
// What is physical in a simulation, as a scene file says it. Plain data in SI units; how it is computed is each
// program's own business. A part that the file does not have is an empty optional or list, and costs nothing.
//
// Reading: read.h. Writing: write.h. The commented example (example.h) explains every key to users.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "libsheet/geometry/axes.h"
#include "libsheet/material/bath_liquid.h"
#include "libsheet/material/liquid.h"
#include "libsheet/scene/motion.h"
#include "libsheet/scene/varying.h"

namespace sheet::scene {

using Eigen::Vector3d;

// Turn by `angle` [rad] about `axis` (any length but zero, right-handed) through the thing's center.
struct Rotation {
  Vector3d axis = Vector3d::UnitY();
  double angle = 0;
  bool operator==(const Rotation&) const = default;
};
[[nodiscard]] Eigen::Matrix3d matrix(const std::optional<Rotation>& rotation);

// ---- the sheet

// Flat shapes lie in the sheet's plane; caps and tubes stand on it, their axis along its normal.
struct Rectangle {
  double size_first, size_second; // along the plane's first and second letter [m]
  bool operator==(const Rectangle&) const = default;
};
struct Disk {
  double radius;
  bool operator==(const Disk&) const = default;
};
struct Annulus {
  double inner_radius, outer_radius;
  bool operator==(const Annulus&) const = default;
};
struct Sphere {
  double radius;
  bool operator==(const Sphere&) const = default;
};
// The part of a sphere within `angle` of its pole (pi/2: a hemisphere), less the part within `opening` of it.
struct Cap {
  double radius, angle, opening; // [m], [rad], [rad]; 0 <= opening < angle <= pi
  bool operator==(const Cap&) const = default;
};
struct Tube {
  double radius, height; // open at both ends, the center halfway up
  bool operator==(const Tube&) const = default;
};
// A mesh file, triangles taken as they are.
struct SheetMesh {
  std::string file;
  double scale; // metres per unit of the file
  bool operator==(const SheetMesh&) const = default;
};
using SheetShape = std::variant<Rectangle, Disk, Annulus, Sphere, Cap, Tube, SheetMesh>;

enum class Pattern { structured, equilateral, irregular };
enum class Plane { xy, xz, yz };

// Thickness from an array of the mesh file: h = scale * value.
struct ThicknessData {
  std::string data; // the array's name in the file
  bool per_face;    // else per vertex
  double scale;     // metres per unit of the file
  bool operator==(const ThicknessData&) const = default;
};

// Directions along which something changes over a sheet: x, y, z, a coordinate along a world axis from the sheet's
// center, before `rotation`; radial, the distance from the sheet's axis (through its center along the plane's normal).
enum class SheetDirection { x, y, z, radial };

// Thickness over a place.
struct ThicknessProfile {
  SheetDirection over;
  PlaceRows rows; // of the thickness [m]
  bool operator==(const ThicknessProfile&) const = default;
};

// Temperature from an array of the mesh file, at vertices or faces, in K.
struct TemperatureData {
  std::string data; // its name in the file
  bool operator==(const TemperatureData&) const = default;
};

// A small deviation d of the start: of the position, along the sheet's normal, or of the thickness.
//   wave   d = amplitude * sin(2 pi s / wavelength + phase)
//          s: the place along the direction; if radial less an annulus' inner radius
//   noise  d uniform in [-amplitude, amplitude], independent at each vertex (position) or triangle (thickness), from
//          `seed`
// Those of the position go on in what enters at the sheet's inlets (libsheet/flow/row_perturbation.h).
struct Wave {
  double wavelength, phase; // [m], [rad]
  SheetDirection direction;
  bool operator==(const Wave&) const = default;
};
struct Noise {
  std::int64_t seed;
  bool operator==(const Noise&) const = default;
};
struct Perturbation {
  bool of_thickness; // else of position
  double amplitude;  // [m]
  std::variant<Wave, Noise> form;
  bool operator==(const Perturbation&) const = default;
};

struct SheetTable {
  std::string name; // by which holds and inflows speak of it; "": none
  SheetShape shape = Rectangle{1, 1};
  std::optional<double> edge_length; // [m]; generated shapes have either this or segments, meshes neither
  // rectangle: first, second letter; else: around, then along (radius, height)
  std::optional<std::array<int, 2>> segments;
  Pattern pattern = Pattern::irregular;
  std::int64_t seed = 0;                                            // of the irregular pattern
  std::variant<double, ThicknessData, ThicknessProfile> thickness;  // [m]
  std::optional<std::variant<double, TemperatureData>> temperature; // [K]; absent: that of [heat]
  std::vector<std::string> arrays; // names of the mesh file's that go along in the frames
  std::vector<Perturbation> perturbations;
  Plane plane = Plane::xz;
  Vector3d center = Vector3d::Zero(); // of the shape (cap: of its sphere; mesh: where the file's origin goes)
  std::optional<Rotation> rotation;
  Vector3d velocity = Vector3d::Zero();         // at the start [m/s]
  Vector3d angular_velocity = Vector3d::Zero(); // likewise, about the center [rad/s]
  double radial_velocity = 0;                   // likewise, away from its axis [m/s]
  std::optional<double> enters;                 // it is there from this time on [s]; absent: from the start
  std::optional<Liquid> material;               // its own; absent: the scene's
  bool operator==(const SheetTable&) const = default;
};

// ---- material, environment, model

// Pressure on the sheet's negative side less that on its positive side [Pa]: blows a closed sheet up.
struct ConstantPressure {
  double value;
  bool operator==(const ConstantPressure&) const = default;
};
// p = value (reference_radius / r)², r the radius of the sphere that has the enclosed volume.
struct InverseSquarePressure {
  double value, reference_radius;
  bool operator==(const InverseSquarePressure&) const = default;
};
// Enclosed gas leaves at the rate Q = conductance * p: p = -(dV/dt) / conductance, V the enclosed volume (openings
// closed by cones to the middle of where their rims started). Slow flow through a round hole of radius a in a thin
// wall: conductance = a³ / (3 mu_gas) [Sampson 1891].
struct DrainingPressure {
  double conductance; // [m³/(Pa s)]
  bool operator==(const DrainingPressure&) const = default;
};
// A given amount of enclosed gas: p = ambient ((amount/V)^exponent - 1), V the enclosed volume (openings closed by
// cones to the middle of their rims) and more_volume; it leaves at the rate leak * p, measured at the pressure outside.
struct GasPressure {
  std::optional<double> amount; // volume that it fills at the pressure outside [m³]; absent: it follows from value
  double value;                 // p at the start [Pa], if amount is absent
  double ambient;               // pressure outside [Pa]
  double exponent;              // polytropic; 1: constant temperature
  double leak;                  // [m³/(Pa s)]; 0: none
  double more_volume;           // of vessels and pipes that the gas fills, too [m³]
  bool operator==(const GasPressure&) const = default;
};
using Pressure = std::variant<ConstantPressure, InverseSquarePressure, DrainingPressure, GasPressure>;
// Whether it depends on the volume that is enclosed.
[[nodiscard]] inline bool depends_on_volume(const Pressure& pressure) {
  return !std::holds_alternative<ConstantPressure>(pressure);
}

// Air that moves at `wind` everywhere, and drags on the sheet (libsheet/energy/form_drag.h).
struct Air {
  double density = 0;                 // [kg/m³]
  double drag_coefficient = 1.2;      // of the pressure on a sheet that moves across itself: of a plate [Hoerner 1965]
  double friction_coefficient = 0.01; // of the friction on both faces of one that moves along itself
  Timed<Vector3d> wind;               // [m/s]
  bool operator==(const Air&) const = default;
};

struct Environment {
  std::optional<Vector3d> gravity; // [m/s²]
  std::optional<Pressure> pressure;
  std::string pressure_sheet; // on which it acts; "": on all, by each closed piece of them where it depends on volume
  std::optional<BathLiquid> bath;
  std::optional<Air> air;
  bool operator==(const Environment&) const = default;
};

struct Model {
  bool inertia = true; // false: creeping flow
  bool bending = true; // false: a membrane
  bool forces = false; // those of holds and solids are wanted
  bool faces = false;  // tension acts on the faces' slopes and on rims, too; needs surface tension
  bool operator==(const Model&) const = default;
};

// ---- heat

// What a face of the sheet loses heat to: transfer (T - ambient) + emissivity σ (T⁴ - radiant⁴) [W/m²].
struct HeatedFace {
  Varying ambient;       // [K]
  Varying transfer;      // [W/(m² K)]
  double emissivity = 0; // 0 to 1
  Varying radiant;       // of what it sees [K]
  [[nodiscard]] bool exchanges() const { return transfers() || emissivity > 0; }
  [[nodiscard]] bool transfers() const { return range_of(transfer).second > 0; }
  bool operator==(const HeatedFace&) const = default;
};

// The liquid has a temperature, which it carries along. Upper: the face on the triangles' positive side.
struct Heat {
  double specific_heat = 0; // [J/(kg K)]
  double conductivity = 0;  // along the sheet [W/(m K)]
  double temperature = 0;   // at the start [K]
  HeatedFace upper = {}, lower = {};
  std::optional<int> profile =
      {}; // modes of the temperature across the thickness; absent: it follows the losses at once
  bool viscous_heating = false;
  bool operator==(const Heat&) const = default;
};

// ---- holds, solids, inflow, tearing, contact

// Parts of the sheet's border as it lies at the start. *_min, *_max: the side where that coordinate is least or
// greatest, before `rotation`. inner_rim: around the hole; outer_rim: the other one; rim: all of the border.
enum class Border { rim, inner_rim, outer_rim, x_min, x_max, y_min, y_max, z_min, z_max };
// Vertices in a part of space, at the start, the sheet in its place.
struct BoxRegion {
  Vector3d low, high;
  bool operator==(const BoxRegion&) const = default;
};
struct SphereRegion {
  Vector3d center;
  double radius;
  bool operator==(const SphereRegion&) const = default;
};
// Vertices where an array of the sheet's mesh file, one number a vertex, is above a half.
struct ArrayRegion {
  std::string array;
  bool operator==(const ArrayRegion&) const = default;
};
using Region = std::variant<Border, BoxRegion, SphereRegion, ArrayRegion>;

struct Hold {
  std::string sheet; // whose vertices; "": of all that there are
  Region region = Border::rim;
  bool clamped = false; // position and slope; else position only
  Axes axes = all_axes; // the coordinates that are held
  Motion motion;
  std::optional<double> until; // released at this time [s]
  // A roll, a clip: the region stays where it is; what enters it is held from then on and moves on by the hold's
  // motion, what leaves it is let go. The region is a box or a sphere.
  bool roll = false;
  bool operator==(const Hold&) const = default;
};

struct SolidBox {
  Vector3d size; // edge lengths
  bool operator==(const SolidBox&) const = default;
};
struct Capsule {
  double radius, length; // along its own y axis; length between the centers of its ends
  bool operator==(const Capsule&) const = default;
};
struct Cylinder {
  double radius, height; // along its own y axis
  bool operator==(const Cylinder&) const = default;
};
// Everything behind the plane through the solid's center.
struct HalfSpace {
  Vector3d normal; // out of the solid, any length but zero
  bool operator==(const HalfSpace&) const = default;
};
struct SolidMesh {
  std::string file;
  double scale;                     // metres per unit of the file
  std::optional<double> voxel_size; // of the distance field [m]; absent: the program chooses
  std::string checksum = {};        // of the file (named_files.h); empty: not known
  bool operator==(const SolidMesh&) const = default;
};
using SolidShape = std::variant<Sphere, SolidBox, Capsule, Cylinder, HalfSpace, SolidMesh>;

// What liquid does that touches a solid: it stays where it touched, flows in a layer that the solid drags, or slides
// without drag.
enum class SolidContact { stick, flow, slip };

struct Solid {
  SolidShape shape = Sphere{1};
  Vector3d center = Vector3d::Zero(); // mesh: where the file's origin goes
  std::optional<Rotation> rotation;
  Motion motion;
  Vector3d surface_velocity = Vector3d::Zero(); // of a belt: what touches moves so, though the shape stays [m/s]
  SolidContact contact = SolidContact::stick;
  double slip_length = 0;              // of what flows: the drag is that of a layer thicker by three times this [m]
  std::optional<double> contact_angle; // of what flows or slips [rad]; absent: the wetted face pulls like a free one
  bool receding = false;               // of what flows: rims may retreat; else they leave a film behind
  std::optional<Timed<double>> temperature; // [K]; absent: it takes no heat
  double contact_conductance = 0;           // of what touches it [W/(m² K)]
  bool operator==(const Solid&) const = default;
};

// New liquid enters at this border; what has entered moves at `velocity`, and at `radial_velocity` away from the axis
// of its sheet, as long as it is at the inlet (inlet_velocity.h). A velocity that is not perpendicular to the border
// gives a slanted curtain.
struct Inflow {
  std::string sheet; // whose border; "": of the only one
  std::variant<Border, ArrayRegion> region = Border::y_max;
  Timed<Vector3d> velocity; // [m/s]
  double thickness = 0;     // [m]
  std::optional<double> until;
  std::optional<Timed<double>> temperature = {}; // [K]; absent: that of [heat]
  Timed<double> radial_velocity = {};            // [m/s]
  bool operator==(const Inflow&) const = default;
};

// What is wholly beyond the plane through `point` leaves the sheet.
struct Outflow {
  Vector3d point = Vector3d::Zero();
  Vector3d normal = Vector3d::UnitX(); // towards what is beyond, any length but zero
  bool operator==(const Outflow&) const = default;
};

// Inclusions that open holes. In a volume of liquid there are, of those that pierce a sheet of the thickness h,
//   N(h) = number (at_thickness/h)^exponent.
struct Inclusions {
  double number = 0;       // that pierce a sheet `at_thickness` thick [1/m³]
  double at_thickness = 0; // [m]
  double exponent = 0;     // > 0
  std::int64_t seed = 1;
  bool operator==(const Inclusions&) const = default;
};

struct Tear {
  std::optional<double> below; // thickness [m]; absent: thinness alone opens nothing
  bool drop_crumbs = false;
  std::optional<Inclusions> inclusions;
  std::optional<double> snap; // width of strands below which they part [m]; absent: that of the shortest edges
  bool drops = false;         // small pieces that come off fly on as balls (libsheet/flow/shed.h)
  bool operator==(const Tear&) const = default;
};

// What lies wholly on another layer of the sheet becomes one with it.
struct Merge {
  std::optional<double> after; // when it has touched for so long [s]; absent: viscosity x its thickness / tension
  bool on_solids = false;      // only where the lower layer lies on a solid
  bool operator==(const Merge&) const = default;
};

struct Contact {
  bool self = true;                // of the sheet with itself
  std::optional<double> stiffness; // of one contact's springs [N/m]; absent: the program chooses
  std::optional<double> adhesion;  // tension at which touching surfaces part again [Pa]; absent: never
  std::optional<double> distance;  // between mid-surfaces that touch [m]; absent: the mean of their thicknesses
  bool operator==(const Contact&) const = default;
};

struct Scene {
  std::vector<SheetTable> sheets = {SheetTable{}}; // at least one; the first is there from the start
  Liquid material;                                 // of the sheets without their own; else that of the first one
  Environment environment;
  Model model;
  std::vector<Hold> holds;
  std::vector<Solid> solids;
  std::vector<Inflow> inflows;
  std::vector<Outflow> outflows;
  std::optional<Tear> tear;
  std::optional<Merge> merge;
  std::optional<Contact> contact;
  std::optional<Heat> heat; // absent: temperature does not exist
  bool operator==(const Scene&) const = default;
};

// The different liquids of the sheets: the scene's first, whether or not a sheet is of it, then the sheets' own in
// their order. Frames tell triangles' liquids by their places in this list (array "liquid"), if it has more than one.
[[nodiscard]] std::vector<Liquid> liquids_of(const Scene& scene);
// The place of the sheet's in that list.
[[nodiscard]] std::size_t liquid_of(const Scene& scene, const SheetTable& sheet);
// The sheet's own, or the scene's.
[[nodiscard]] const Liquid& material_of(const Scene& scene, const SheetTable& sheet);
// The scene as if all of it were of the sheet's liquid: what is judged by one liquid judges that.
[[nodiscard]] Scene with_material_of(const Scene& scene, const SheetTable& sheet);

// The sheet of this name, or the first one for "". Precondition: there is one.
[[nodiscard]] const SheetTable& sheet_named(const Scene& scene, const std::string& name);

// Figures of a generated shape, at the start; a mesh has none here.
struct ShapeSize {
  double length;   // the length by which forces and flows are judged: shortest side, radius, width of an annulus [m]
  double smallest; // an edge longer than this cannot make the shape [m]
  double area;     // [m²]
};
[[nodiscard]] std::optional<ShapeSize> size_of(const SheetShape& shape);

// The borders that the sheet has by name; a mesh may have any.
[[nodiscard]] std::vector<Border> borders_of(const SheetTable& sheet);

// The axis of a sheet: through its center along its plane's normal.
struct SheetAxis {
  Vector3d center = Vector3d::Zero(), direction = Vector3d::UnitY(); // [m], of length 1
  // The unit vector out of the axis to x; 0 on it.
  [[nodiscard]] Vector3d outward(const Vector3d& x) const;
};
[[nodiscard]] SheetAxis axis_of(const SheetTable& sheet);

// Axes of a plane: first letter, second letter, normal (the third axis, always positive).
struct PlaneAxes {
  int first, second, normal; // 0 x, 1 y, 2 z
};
[[nodiscard]] PlaneAxes axes_of(Plane plane);

// Whether the sheet encloses gas, compressed.
[[nodiscard]] bool encloses_gas(const Scene& scene);

// Whether liquid that touches flows or slips along any of the scene's solids.
[[nodiscard]] bool flows_on_solids(const Scene& scene);

// Whether what comes off the scene's solids falls for ever: no plane, but one that is upright or overhangs, no bath and
// no outflow that looks down takes it up.
[[nodiscard]] bool is_bottomless(const Scene& scene);

// Whether there is weight, but no inertia, and nothing but solids on which the sheet would come to rest: what touches
// none falls at no speed that the model could tell.
[[nodiscard]] bool nothing_resists_fall(const Scene& scene);

// Whether what sticks to a solid may be squeezed by another one: where there are several and one of them moves.
[[nodiscard]] bool solids_squeeze(const Scene& scene);

// Whether layers that lie on each other flow along each other: where liquid flows on solids or spreads on a bath.
[[nodiscard]] bool layers_flow(const Scene& scene);
// Whether what touches sticks: contact springs pull, too. They do unless the scene's adhesion is 0.
[[nodiscard]] bool contacts_adhere(const Scene& scene);

// Whether liquid enters or leaves: what sheet-emit does.
[[nodiscard]] bool flows_in_or_out(const Scene& scene);

// Up: against gravity; nothing without gravity.
[[nodiscard]] std::optional<Vector3d> up(const Environment& environment);

} // namespace sheet::scene

namespace sheet {
using scene::contacts_adhere;
using scene::encloses_gas;
using scene::flows_in_or_out;
using scene::flows_on_solids;
using scene::layers_flow;
using scene::Scene;
using scene::sheet_named;
using scene::SolidContact;
using scene::solids_squeeze;
} // namespace sheet
