// SPDX-License-Identifier: MIT
#include "formats/cpp/byte_store.h"
#include "formats/cpp/export_check.h"
#include "formats/cpp/mesh_export.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {

namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text)
    switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    case '"':
      result += "&quot;";
      break;
    default:
      result += c;
    }
  return result;
}

class Writer {
public:
  // Declares an array and appends its numbers, which put() appends one after the other.
  template <class Put>
  void array(const char* type, std::size_t number_bytes, const std::string& name, int components, std::size_t numbers,
             Put put) {
    xml += std::string("<DataArray type=\"") + type + "\" Name=\"" + escaped(name) + "\"" +
           (components > 1 ? " NumberOfComponents=\"" + std::to_string(components) + "\"" : "") +
           " format=\"appended\" offset=\"" + std::to_string(data.size()) + "\"/>\n";
    data.reserve(data.size() + 8 + numbers * number_bytes);
    store_number(data, std::uint64_t{numbers} * number_bytes);
    put();
  }

  void arrays(const ForeignMesh& mesh, MeshPlace place, const char* section) {
    xml += std::string("<") + section + ">\n";
    for (const MeshArray& a : mesh.arrays)
      if (a.place == place)
        array("Float64", 8, a.name, a.components, a.values.size(), [&] {
          for (const double x : a.values)
            store_number(data, x);
        });
    xml += std::string("</") + section + ">\n";
  }

  std::string xml, data;
};

// What ParaView takes for the time of a single file.
std::string time_of(const ForeignMesh& mesh) {
  if (!mesh.time)
    return "";
  std::string text =
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">";
  append_real(text, *mesh.time);
  return text + "</DataArray>\n</FieldData>\n";
}

} // namespace

std::string encode_vtu(const ForeignMesh& mesh) {
  check_export(mesh);
  Writer w;
  const std::size_t cells = mesh.triangles.size();
  w.xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n" +
          time_of(mesh) + "<Piece NumberOfPoints=\"" + std::to_string(mesh.points.size()) + "\" NumberOfCells=\"" +
          std::to_string(cells) + "\">\n";
  w.arrays(mesh, MeshPlace::point, "PointData");
  w.arrays(mesh, MeshPlace::cell, "CellData");
  w.xml += "<Points>\n";
  w.array("Float64", 8, "Points", 3, 3 * mesh.points.size(), [&] {
    for (const auto& point : mesh.points)
      for (const double x : point)
        store_number(w.data, x);
  });
  w.xml += "</Points>\n<Cells>\n";
  w.array("Int64", 8, "connectivity", 1, 3 * cells, [&] {
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t vertex : triangle)
        store_number(w.data, std::int64_t{vertex});
  });
  w.array("Int64", 8, "offsets", 1, cells, [&] {
    for (std::size_t i = 1; i <= cells; ++i)
      store_number(w.data, static_cast<std::int64_t>(3 * i));
  });
  w.array("UInt8", 1, "types", 1, cells, [&] { w.data.append(cells, '\5'); }); // 5: VTK_TRIANGLE
  w.xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return w.xml + w.data + "\n</AppendedData>\n</VTKFile>\n";
}

std::string encode_pvd(std::span<const PvdEntry> entries) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
                     "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const PvdEntry& entry : entries) {
    text += "<DataSet timestep=\"";
    append_real(text, entry.time);
    text += "\" part=\"0\" file=\"" + escaped(entry.file) + "\"/>\n";
  }
  return text + "</Collection>\n</VTKFile>\n";
}

} // namespace sheet::formats
