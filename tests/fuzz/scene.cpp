// SPDX-License-Identifier: GPL-3.0-or-later
// The scene reader against any text: it returns a scene or throws Error, and what it returns survives its canonical
// text. Input: the scene file, then after a zero byte one --set, and so on.
//   clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined -I.
//   -I/usr/include/eigen3 \
//     tests/fuzz/scene.cpp libsheet/base/units.cpp libsheet/scene/*.cpp -lfmt -o fuzz-scene
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "libsheet/base/error.h"
#include "libsheet/scene/explain.h"
#include "libsheet/scene/read.h"
#include "libsheet/scene/write.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const std::string_view text = rest.substr(0, rest.find('\0'));
  std::vector<std::string> sets;
  while (rest.find('\0') != std::string_view::npos) {
    rest.remove_prefix(rest.find('\0') + 1);
    sets.emplace_back(rest.substr(0, rest.find('\0')));
  }
  sheet::Scene scene;
  try {
    scene = sheet::parse_scene(text, "scene.toml", sets);
  } catch (const sheet::Error&) {
    return 0;
  }
  const std::string canonical = sheet::to_toml(scene);
  if (sheet::parse_scene(canonical, "canonical") != scene || sheet::to_toml(scene) != canonical) {
    std::fputs(canonical.c_str(), stderr);
    std::abort();
  }
  (void)to_text(sheet::scene::explain(scene));
  return 0;
}
