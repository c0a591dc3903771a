// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of scenes for these tests.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/scene/read.h"
#include "tests/unit/own_path.h"

namespace sheet::scene {

inline const std::string disk = "[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.02\n";
inline const std::string liquid = "[material]\nviscosity = 100\ndensity = 1000\n";

// A folder of the test's own, for a scene and the file that it names.
class FolderOfScene : public testing::Test {
protected:
  FolderOfScene() : folder_(test::own_path("scene")) { std::filesystem::create_directories(folder_); }
  ~FolderOfScene() override { std::filesystem::remove_all(folder_); }
  // scene.toml, as read, beside a file of this name and content.
  Scene read_beside(const std::string& name, const std::string& content, const std::string& scene) {
    std::ofstream(folder_ / name) << content;
    std::ofstream(folder_ / "scene.toml") << scene;
    return read_scene(folder_ / "scene.toml");
  }
  std::filesystem::path folder_;
};

// What is wrong with a text, or "fine".
inline std::string problem(const std::string& text, const std::vector<std::string>& sets = {}) {
  try {
    (void)parse_scene(text, "s", sets);
    return "fine";
  } catch (const Error& error) {
    return error.what();
  }
}

// A scene that uses every table.
inline const std::string everything = R"([sheet]
shape = "annulus"
inner_radius = "0.1 m"
outer_radius = 0.25
edge_length = "10 mm"
pattern = "irregular"
seed = 3
thickness = "2 mm"
perturbation = [{amplitude = "0.1 mm", wavelength = "75 mm", direction = "radial"}, {of = "thickness", amplitude = 1e-4, seed = 7}]
plane = "xz"
center = [0, 1, 0]
rotation = {axis = [0, 0, 1], angle = "45 deg"}
velocity = [0, "-1 m/s", 0]
angular_velocity = [0, 2, -3]
radial_velocity = 0.5
[material]
viscosity = "100 Pa*s"
density = "0.978 g/cm^3"
surface_tension = "72.8 mN/m"
[environment]
gravity = [0, -9.81, 0]
pressure = {law = "constant", value = "10 Pa"}
bath = {density = 1200, level = 0.5}
air = {density = 1.2, wind = [[0, 0, 0, 0], [1, 3, 0, 0]]}
[model]
inertia = true
bending = true
faces = true
[[hold]]
region = "inner_rim"
kind = "clamped"
motion = {kind = "rotating", axis = [0, 1, 0], rate = [[0, 0.0], [5, "0.3 rad/s"]]}
[[hold]]
region = {box = [[-1, -1, -1], [0, 1, 1]]}
axes = "zx"
motion = {kind = "translating", velocity = [[0, 0, 0, 0], [1, 0, 0, "0.4 m/s"]]}
until = "2 s"
[[hold]]
region = {sphere = {center = [0, 0, 0], radius = "1 cm"}}
[[solid]]
shape = "mesh"
file = "meshes/b.off"
scale = 0.01
voxel_size = "1 mm"
checksum = "0123456789abcdef"
center = [0, -1, 0]
motion = {kind = "rotating", axis = [0, 1, 0], rate = 1}
[[solid]]
shape = "plane"
surface_velocity = [0, 0, 0.4]
contact = "flow"
slip_length = "1 um"
contact_angle = "60 deg"
receding = true
[inflow]
region = "outer_rim"
velocity = [0, -1, 0]
radial_velocity = -0.5
until = 1
[[outflow]]
point = [0, "-2 m", 0]
normal = [0, -1, 0]
[tear]
below = "0.8 mm"
crumbs = "drop"
sites = "0.02 1/cm^3"
at_thickness = "0.6 mm"
exponent = 6
seed = 4
snap = "20 um"
drops = true
[merge]
after = "0.3 s"
on = "solids"
[contact]
self = true
stiffness = 1.5
adhesion = "10 Pa"
distance = "1.5 mm"
)";

} // namespace sheet::scene
