// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/import_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return check_import(data, size, sheet::formats::MeshFormat::obj);
}
