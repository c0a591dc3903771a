// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/example.h"

#include <string>

#include "libsheet/scene/keys.h"

namespace sheet::scene {

// A setting that ends in ? gets the help of its key (keys.h). In two pieces: compilers need not take longer literals.
static constexpr std::string_view sheet_and_physics = R"toml(# A square sheet of caramel falls on a ball.
#
# A scene says what is physical; how it is computed is said by each program's options.
# A number is in SI units (m, kg, s, Pa, N, radians). A text carries its unit: "2.5 mm", "100 Pa*s", "45 deg", "21 mN/m".
# Tables that are absent cost nothing. Lines that begin with # and no blank are settings to choose from.
# Override any value from the command line: --set material.viscosity=50   --set hold.0.kind=clamped

[sheet] # ---------------------------------------------------------------- the liquid sheet at the start

# Its shape. Flat shapes lie in `plane`; caps and tubes stand on it.
shape = "rectangle"
size = ["1 m", "1 m"]?

#shape = "disk"
#radius = "0.5 m"

#shape = "annulus"
#inner_radius = "0.1 m"
#outer_radius = "0.25 m"

#shape = "sphere"
#radius = "0.5 m"

# A part of a sphere.
#shape = "cap"
#radius = "0.1 m"
#angle = "90 deg"?
#opening = "18 deg"?

# Open at both ends, its axis along the plane's normal.
#shape = "tube"
#radius = "0.2 m"
#height = "0.5 m"

# Triangles fine enough to begin with; or counts. "structured", "equilateral" or "irregular" (different for each seed, and
# the best for honest results: no direction is preferred).
edge_length = "25 mm"?
pattern = "irregular"?
seed = 1?

#segments = [60, 60]?

thickness = "10 mm"?

# Or rows of a distance from the sheet's axis and the thickness there, linear in between, constant beyond; or of a
# coordinate from its center.
#thickness = {radial = [[0, "10 mm"], ["0.4 m", "12 mm"]]}

#thickness = {along = "x", rows = [["-0.5 m", "8 mm"], ["0.5 m", "12 mm"]]}

# Or any mesh file (.obj .off .ply .stl .vtu), or the last frame of a stream (.sheet), with its velocity; also its
# thickness, from an array at each vertex or face (of a stream: place = "face").
#shape = "mesh"
#file = "leaf.ply"?
#scale = 0.001?
#thickness = {data = "thickness", place = "vertex", scale = 0.001}
#arrays = ["uv", "material"]?

# Small deviations, to let wrinkles begin: a wave of the position (along the normal) or of the thickness, along x, y, z or
# "radial" (outwards), or noise at each vertex. Several may be given in a list. Those of the position go on in what an
# inlet brings.
#perturbation = {amplitude = "0.1 mm", wavelength = "75 mm", direction = "x", phase = "0 deg"}

#perturbation = {of = "thickness", amplitude = "0.1 mm", seed = 7}

# Where it is, how it is turned, how it moves.
plane = "xz"?
center = [0, 0, 0]?
rotation = {axis = [0, 1, 0], angle = "0 deg"}
velocity = [0, 0, 0]?
angular_velocity = [0, "0 rpm", 0]?
#radial_velocity = "0.1 m/s"?

# Several sheets: [[sheet]] in place of [sheet], once for each. name = "lid" lets a [[hold]] and an [inflow] speak of one of
# them, sheet = "lid"; enters = "2 s" lets it come in at that time (not the first one). A sheet's own liquid, wholly in place
# of that of [material], stands below it under [sheet.material].

[material] # ------------------------------------------------------------- the liquid

viscosity = "80 Pa*s"?
density = "1300 kg/m^3"?

#surface_tension = "40 mN/m"?

# Viscosity may depend on the rate of strain. It is a power of it, and `viscosity` at reference_rate (polymers, ice, batter);
#law = "power"?
#flow_index = 0.5?
#reference_rate = "1 s^-1"?

# or nothing flows below a yield stress (toothpaste; "herschel_bulkley" takes flow_index, too; "casson" is chocolate);
#law = "bingham"
#yield_stress = "30 Pa"?
#rest_rate = "1e-5 s^-1"?

# or it thins from one viscosity to another ("cross" likewise, without transition);
#law = "carreau"
#zero_viscosity = "80 Pa*s"?
#infinite_viscosity = "2 Pa*s"?
#time_constant = "0.1 s"?
#flow_index = 0.4
#transition = 1.5?
#density = "1300 kg/m^3"

# or it is as measured; or file = "curve.csv", beside the scene: columns rate [1/s], viscosity [Pa*s], named in its first line.
#law = "table"
#rates = ["0.1 s^-1", 1, 10, 100]?
#viscosities = ["90 Pa*s", 80, 30, 9]?
#density = "1300 kg/m^3"

# Viscosity may also depend on temperature: see [heat], at the end.

[environment] # ---------------------------------------------------------- what acts on it from outside; may be absent

gravity = [0, "-9.81 m/s^2", 0]

# Pressure inside less pressure outside (from the negative side of the triangles to the positive one): constant;
#pressure = {law = "constant", value = "10 Pa"}

# or falling with the square of the radius of a sphere with the enclosed volume (with shape = "sphere" or alike);
#[sheet]
#shape = "sphere"
#radius = "0.5 m"
#[environment]
#pressure = {law = "inverse_square", value = "10 Pa", reference_radius = "0.5 m"}

# or of enclosed gas that leaves by a hole, `conductance` cubic metres a second for each pascal: a³ / (3 mu) for a small hole
# of radius a and a gas of viscosity mu (air: 1.8e-5 Pa*s).
#[sheet]
#shape = "cap"
#radius = "0.1 m"
#angle = "90 deg"
#[environment]
#pressure = {law = "draining", conductance = "1e-4 m^3/(Pa*s)"}

# or of a given amount of enclosed gas, p = ambient ((amount/V)^exponent - 1), V the enclosed volume. `amount`: the volume
# that it would fill outside; or `value`, its pressure at the start. exponent: 1 as it keeps its temperature (default), 1.4
# for air without time to cool. ambient: pressure outside (default 101325 Pa); leak: a hole's conductance as above
# (default 0); more_volume: of vessels and pipes that the gas fills, too (default 0). Where the sheet tears, or a rim comes
# off what closed it, gas leaves by itself.
#[sheet]
#shape = "sphere"
#radius = "0.1 m"
#[environment]
#pressure = {law = "gas", value = "2 Pa", exponent = 1.4, ambient = "1 bar", leak = "1e-8 m^3/(Pa*s)", more_volume = "1 cm^3"}

# Where there are several sheets, or pieces of one, each closed one encloses a volume of its own, and has a pressure, a hole
# and an amount of its own. sheet: the only one on which pressure acts.
#[sheet]
#name = "balloon"
#shape = "sphere"
#radius = "0.1 m"
#[environment]
#pressure = {law = "gas", value = "2 Pa", sheet = "balloon"}

# A heavy liquid below the sheet, up to the height `level` against gravity. It carries what is under its surface, and
# takes from what has gone under the weight of as much of the bath; with clings = true it pulls down what is above it,
# too, so that the sheet cannot leave it. Unless spreads = false, or it clings, the sheet spreads on it by its own weight,
# as glass on tin; drag: what slides on it is held back so, its viscosity over its depth where that is shallow (default 0).
#bath = {density = "1200 kg/m^3", level = "-0.5 m", clings = false, spreads = true, drag = "50 Pa*s/m"}

# Air drags on what moves through it, across itself as on a plate, along itself by friction: it holds back films that are
# thinner than some 0.2 mm. It moves everywhere at `wind`; what touches a solid or another layer, or is under a bath, it
# does not reach. On what floats it rubs from above.
#air = {density = "1.2 kg/m^3", drag_coefficient = 1.2, friction_coefficient = 0.01, wind = ["3 m/s", 0, 0]}

[model] # ---------------------------------------------------------------- what to leave out; may be absent

inertia = true?
bending = true?
#forces = true?
#faces = true?
)toml";

static constexpr std::string_view things = R"toml(
# ------------------------------------------------------------------------ what is held in place: any number of [[hold]]

# region: "rim" (all of the border), "inner_rim", "outer_rim", or the side "x_min", "x_max", ... "z_max" (as the sheet lies
# before `rotation`), what is in a part of space at the start, or, {array = "painted"}, where an array of the sheet's PLY
# file is above 0.5. "pinned" holds the position, "clamped" the slope too.
#[[hold]]
#region = "x_min"
#kind = "pinned"

# Held in some directions only, until a time when it is let go.
#[[hold]]
#region = {box = [[-0.5, -0.1, -0.5], [-0.4, 0.1, 0.5]]}
#kind = "pinned"?
#axes = "xz"?
#until = "2 s"?

# Turned about an axis through `center` (by default the sheet's), faster and faster for 5 s, then steadily. Rows are
# [time, rate], straight lines between them.
#[[hold]]
#region = {sphere = {center = [0, 0, 0], radius = "0.1 m"}}
#kind = "clamped"
#motion = {kind = "rotating", axis = [0, 1, 0], center = [0, 0, 0], rate = [[0, 0], ["5 s", "0.3 rad/s"]]}

# Moved; a velocity that changes has rows [time, x, y, z].
#[[hold]]
#region = "z_max"
#motion = {kind = "translating", velocity = [0, 0, "0.1 m/s"]}

#[[hold]]
#region = "z_max"
#motion = {kind = "translating", velocity = [["0 s", 0, 0, 0], ["1 s", 0, 0, 0.1]]}

# A roll, or a clip.
#[[hold]]
#region = {box = [[0.9, -1, -1], [1.1, 1, 1]]}
#roll = true?
#motion = {kind = "translating", velocity = ["0.5 m/s", 0, 0]}

# ------------------------------------------------------------------------ solids: any number of [[solid]]
# Liquid that touches a solid sticks to it, for good unless [contact] has an adhesion; `contact` (below) lets it flow or slip.
# `motion` as for holds (turning about the solid's own center).

[[solid]]
shape = "sphere"
radius = "0.2 m"
center = [0, "-0.3 m", 0]

#[[solid]]
#shape = "box"
#size = [0.2, 0.1, 0.2]
#center = [0, -0.4, 0]
#rotation = {axis = [0, 1, 0], angle = "30 deg"}

# Capsules and cylinders stand along y unless they are turned.
#[[solid]]
#shape = "capsule"
#radius = "0.05 m"
#length = "0.4 m"?
#center = [0, -0.4, 0]
#velocity = [0.4, 0, 0]?
# angular_velocity = [0, "10 rpm", 0] is for one that rotates about the center; with `velocity`, about a center that moves.

#[[solid]]
#shape = "cylinder"
#radius = "0.1 m"
#height = "0.6 m"
#center = [0, -0.4, 0]
#rotation = {axis = [1, 0, 0], angle = "90 deg"}
#motion = {kind = "rotating", axis = [0, 0, 1], rate = "10 rpm"}

# Led through places, rotations (unit quaternions [w, x, y, z]), or both, at times; at rest before and after. Or file =
# "arm.csv", beside the scene: columns time [s], x [m], y [m], z [m], qw, qx, qy, qz, named in its first line. A solid that
# does not say its center or rotation is where the rows have it at time 0. interpolation: "smooth" (the default; it never
# goes beyond the two rows that it is between), "linear" (constant velocity, which jumps at the rows) or "step" (it rests
# and jumps at the rows). Smooth rows keep their pace up to both ends: one that is repeated lets it start or stop gently.
# For holds, too.
#[[solid]]
#shape = "box"
#size = [0.2, 0.02, 0.1]
#center = [0, -0.4, 0]
#motion = {kind = "keyframed", times = [0, "0.5 s", "1 s"], places = [[0, -0.4, 0], [0.1, -0.3, 0], [0.2, -0.4, 0]], interpolation = "smooth"}

# The ground, or a conveyor belt.
#[[solid]]
#shape = "plane"
#center = [0, "-0.8 m", 0]
#normal = [0, 1, 0]?
#surface_velocity = [0, 0, "25 mm/s"]?

# What liquid does that touches: "stick" (it stays where it touched, the default), "flow" (it flows in a layer that the solid
# drags) or "slip" (no drag).
#[[solid]]
#shape = "plane"
#center = [0, "-0.8 m", 0]
#contact = "flow"
#slip_length = "10 um"?
#contact_angle = "60 deg"?
#receding = true?

# A mesh (.obj .off .ply .stl) or a distance field (.vdb). By its checksum stages find the file and tell whether it has changed.
#[[solid]]
#shape = "mesh"
#file = "bunny.off"?
#scale = 2.0?
#voxel_size = "5 mm"?
#checksum = "0123456789abcdef"?
#center = [0, -0.6, 0]

# ------------------------------------------------------------------------ new liquid that flows in at a border

# A velocity at an angle to the border makes a slanted curtain. The border may also be one that an array of the sheet's PLY
# file has above 0.5: {array = "painted"}.
#[inflow]
#region = "z_max"?
#velocity = [0, 0, "-0.1 m/s"]?
#thickness = "2.5 mm"?
#until = "10 s"?

# Out of a ring, as from the inner rim of an annulus or of a cap with an opening: away from the sheet's axis, through its
# center along its plane's normal.
#[sheet]
#shape = "cap"
#radius = "10 mm"
#angle = "45 deg"
#opening = "30 deg"
#edge_length = "1 mm"
#[inflow]
#region = "inner_rim"
#velocity = [0, "-1 m/s", 0]
#radial_velocity = "1.7 m/s"?
#thickness = "0.3 mm"

# ------------------------------------------------------------------------ where liquid leaves: any number of [[outflow]]

# What is wholly beyond a plane.
#[[outflow]]
#point = [0, "-2 m", 0]?
#normal = [0, -1, 0]?

# ------------------------------------------------------------------------ where the sheet tears

# Below a thickness, wherever that is; where inclusions pierce the sheet, of which sites (at_thickness/h)^exponent in a
# volume pierce one of the thickness h; strands where they are narrower than snap. Each by itself, or together. With
# drops what comes off in small pieces flies on as balls; else threads and crumbs are lost (tear.volume).
#[tear]
#below = "0.8 mm"?
#crumbs = "keep"?
#sites = "2e4 1/m^3"?
#at_thickness = "0.6 mm"?
#exponent = 6?
#seed = 1?
#snap = "20 um"?
#drops = true?

# ------------------------------------------------------------------------ layers that lie on each other become one

#[merge]
#after = "0.3 s"?
#on = "all"?

# ------------------------------------------------------------------------ contact of the sheet with itself

# All keys may be absent.
[contact]
self = true?

#[contact]
#self = true
#stiffness = "1.5 N/m"?
#adhesion = "100 Pa"?
#distance = "5 mm"?

# ------------------------------------------------------------------------ heat: the liquid has a temperature

# Both faces lose heat alike, unless `upper` or `lower` says otherwise.
#[heat]
#specific_heat = "2400 J/(kg*K)"?
#conductivity = "0.5 W/(m*K)"?
#profile = 3?
#temperature = "60 degC"?
#ambient = "20 degC"?
#transfer = "15 W/(m^2*K)"?
#emissivity = 0.9?
#radiant = "15 degC"?
#upper = {ambient = "30 degC", transfer = "50 W/(m^2*K)", emissivity = 0.8, radiant = "20 degC"}
#lower = {transfer = 0, emissivity = 0}
#viscous_heating = true?

# ambient, transfer and radiant may change over time, in rows [time, value], or over a coordinate of the world: an oven.
#[heat]
#specific_heat = "1250 J/(kg*K)"
#temperature = "500 degC"
#ambient = [["0 s", "500 degC"], ["10 s", "900 degC"]]
#transfer = {along = "y", rows = [[0, "15 W/(m^2*K)"], ["0.1 m", 60]]}
#emissivity = 0.9
#radiant = {along = "x", rows = [["-0.1 m", "500 degC"], [0, "900 degC"], ["0.1 m", "500 degC"]]}

# Solids take heat where they have a temperature, which stays as they say; rows are [time, temperature]. What enters may have
# its own, and each sheet.
#[heat]
#specific_heat = "2400 J/(kg*K)"
#temperature = "60 degC"
#[sheet]
#temperature = "65 degC"?
#[inflow]
#region = "z_max"
#velocity = [0, 0, "-0.1 m/s"]
#temperature = "70 degC"?
#[[solid]]
#shape = "plane"
#center = [0, "-0.8 m", 0]
#temperature = "20 degC"?
#contact_conductance = "500 W/(m^2*K)"?

# `viscosity` is that at reference_temperature; all of a flow curve is shifted along; stress is what yields, and stays.
# Arrhenius;
#[heat]
#specific_heat = "2400 J/(kg*K)"
#temperature = "60 degC"
#[material]
#viscosity_law = "arrhenius"?
#reference_temperature = "40 degC"?
#activation_energy = "60 kJ/mol"?

# or exponential;
#[heat]
#specific_heat = "2400 J/(kg*K)"
#temperature = "60 degC"
#[material]
#viscosity_law = "exponential"
#reference_temperature = "40 degC"
#temperature_coefficient = "0.05 1/K"?

# or as Vogel, Fulcher and Tammann have it, with the viscosity in it, here of window glass (without vft_a `viscosity` counts);
#[heat]
#specific_heat = "2400 J/(kg*K)"
#temperature = "60 degC"
#[material]
#viscosity_law = "vft"
#reference_temperature = "900 degC"
#vft_a = -2.601?
#vft_b = "4330.9 K"?
#vft_temperature = "246.1 degC"?
#density = "2500 kg/m^3"

# or as Williams, Landel and Ferry do (polymers);
#[heat]
#specific_heat = "2400 J/(kg*K)"
#temperature = "60 degC"
#[material]
#viscosity_law = "wlf"
#reference_temperature = "100 degC"
#wlf_c1 = 17.44?
#wlf_c2 = "51.6 K"?

# or as measured; or temperature_file = "glass.csv", beside the scene: columns temperature [degC], viscosity [Pa*s]. Surface
# tension may change with temperature, too.
#[heat]
#specific_heat = "2400 J/(kg*K)"
#temperature = "60 degC"
#[material]
#viscosity_law = "table"
#reference_temperature = "40 degC"
#temperatures = ["20 degC", "40 degC", "60 degC", "80 degC"]?
#temperature_viscosities = ["90 Pa*s", 20, 6, 2.5]?
#density = "1300 kg/m^3"
#surface_tension = "40 mN/m"
#surface_tension_slope = "-0.1 mN/(m*K)"?
)toml";

namespace {

// The table of keys that a line "[tear]" or "#[[hold]]" opens; null if it opens none.
const KeyTable* opened(std::string_view line) {
  line.remove_prefix(line.starts_with('#') ? 1 : 0);
  if (!line.starts_with('['))
    return nullptr;
  line.remove_prefix(line.find_first_not_of('['));
  const Key* key = scene_keys().find(line.substr(0, line.find(']')));
  return key ? key->below : nullptr;
}

// Every setting that ends in ? with what its key is behind it.
std::string with_help(std::string_view text) {
  std::string result;
  const KeyTable* table = &scene_keys();
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() + 1);
    if (const KeyTable* next = opened(line))
      table = next;
    if (!line.ends_with('?')) {
      result.append(line) += '\n';
      continue;
    }
    line.remove_suffix(1);
    const std::string_view setting = line.substr(line.starts_with('#') ? 1 : 0);
    result += fmt::format("{:<31} # {}\n", line, table->find(setting.substr(0, setting.find(' ')))->help);
  }
  return result;
}

} // namespace

std::string_view example() {
  static const std::string text = with_help(std::string(sheet_and_physics).append(things));
  return text;
}

} // namespace sheet::scene
