// SPDX-License-Identifier: GPL-3.0-or-later
// Every key that a scene file may have, told once: the readers (reader.h) take from here what kind of value a key has,
// sheet-init lists them, completes them and explains them in its example.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libsheet/base/units.h"
#include "libsheet/scene/document.h"

namespace sheet::scene {

struct KeyTable;

struct Key {
  enum class Form { quantity, list, timed, text, word, file, boolean, integer, table };
  std::string_view name;
  Form form;
  std::string_view help;                        // a line, without full stop
  const Quantity* quantity = nullptr;           // of a number, or of each of a list
  std::string_view dimensions = "";             // of a list, "[3]", "[][3]"; of a timed value, those at one time
  std::span<const std::string_view> words = {}; // to choose from; of a file: the endings that its name may have
  const KeyTable* below = nullptr;              // of a table, or of a value that may also be a table
};

struct KeyTable {
  std::string_view name;
  std::span<const Key> keys;

  [[nodiscard]] const Key* find(std::string_view key) const;
};

// The tables of a scene, as keys of one above them.
[[nodiscard]] const KeyTable& scene_keys();

// Those of them that have a key of this name, as they are written: "[material]", "[[solid]]".
[[nodiscard]] std::vector<std::string> tables_with(std::string_view key);

// A key with the way to it from the top of the scene, in the words of --set: "material.viscosity", "hold.N.kind" for
// one in a list of tables, whose items N counts from 0.
struct ListedKey {
  std::string path;
  const Key& key;
};
// All keys that are no tables, in the order in which they are declared.
[[nodiscard]] std::vector<ListedKey> listed_keys();

// Each as a setting begins that gives it, "material.viscosity=", in lists of tables the first one: for shells to offer.
[[nodiscard]] std::vector<std::string> begun_settings();

// What a key's value may be, for people and programs:
//   length                 a quantity
//   length[3]              a list of three; length[][3]: any number of lists of three
//   velocity[3] or rows    constant, or rows [time, ...]
//   pinned|clamped         one of these words
//   file (.obj .off)       a file's name with one of these endings
//   text, integer, boolean
// "... or table": or the keys that are listed below it.
[[nodiscard]] std::string kind_of(const Key& key);

// The SI unit of its numbers; "" if it has none.
[[nodiscard]] std::string_view unit_of(const Key& key);

// A file that a scene names, as it says it, and the key that does.
struct NamedFile {
  std::string name, path; // path: "solid.0.file"
};
// In the order of the keys. The document need not be a good scene.
[[nodiscard]] std::vector<NamedFile> files_named_in(const Node& document);

} // namespace sheet::scene
