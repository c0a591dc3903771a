// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/place_report.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "libsheet/measure/csv.h"
#include "libsheet/measure/cut.h"
#include "libsheet/measure/cut_plane.h"

namespace sheet {

namespace {

// Between two places there are no contacts, and the logarithm is there for pictures.
bool has_a_value_in_between(const Field& field) { return field.palette.kinds.empty() && field.name != "log_viscosity"; }

// Rows of places of one frame after the other.
class PlaceReport : public Report {
public:
  explicit PlaceReport(std::string_view columns) : columns_(columns) {}

  std::string add(const ReportEntry& entry) override {
    std::string out = chosen_ ? "" : head(*entry.frame, entry.many_files);
    values_.clear();
    for (const Field* field : *chosen_)
      values_.push_back(has(*entry.frame, *field) ? values_of(*entry.frame, *field)
                                                  : std::vector<double>(entry.frame->rows_at(field->where), absent));
    out_.clear();
    entry_ = &entry;
    add_rows(*entry.frame);
    return out + std::exchange(out_, {});
  }
  std::string end() override { return chosen_ ? "" : head({}, false); }

protected:
  virtual void add_rows(const formats::Frame& frame) = 0;

  // `own`: of the columns between the time and the place.
  void add_row(const std::string& own, const std::optional<SurfacePoint>& point) {
    const formats::Frame& frame = *entry_->frame;
    out_ += fmt::format("{},{},{}", entry_->index, frame.time, own);
    const Vector3 x = point ? position_of(frame, *point) : Vector3(Vector3::Constant(absent));
    for (const double coordinate : x)
      out_ += "," + csv_number(coordinate);
    for (std::size_t i = 0; i < chosen_->size(); ++i)
      out_ += "," + csv_number(point ? value_at(frame, *(*chosen_)[i], values_[i], *point) : absent);
    out_ += (entry_->many_files ? "," + csv_quoted(entry_->file) : "") + "\n";
  }

private:
  std::string head(const formats::Frame& first, bool many_files) {
    chosen_.emplace();
    std::string line = "frame,time," + columns_ + ",x,y,z";
    for (const Field& field : fields())
      if (has_a_value_in_between(field) && has(first, field)) {
        chosen_->push_back(&field);
        line += fmt::format(",{}", field.name);
      }
    return line + (many_files ? ",file\n" : "\n");
  }

  std::string columns_, out_;
  std::optional<std::vector<const Field*>> chosen_;
  std::vector<std::vector<double>> values_; // of the chosen, in this frame
  const ReportEntry* entry_ = nullptr;
};

class CutReport : public PlaceReport {
public:
  explicit CutReport(const std::vector<std::string>& planes) : PlaceReport("cut,curve,s") {
    for (const std::string& plane : planes)
      planes_.push_back(parse_cut_plane(plane));
  }

private:
  void add_rows(const formats::Frame& frame) override {
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      const std::vector<CutCurve> curves = cut(frame, planes_[p]);
      for (std::size_t c = 0; c < curves.size(); ++c) {
        double s = 0;
        for (const auto& [start, end] : curves[c]) {
          add_row(fmt::format("{},{},{}", p, c, s), start);
          s += (position_of(frame, end) - position_of(frame, start)).norm();
          add_row(fmt::format("{},{},{}", p, c, s), end);
        }
      }
    }
  }

  std::vector<CutPlane> planes_;
};

class PointReport : public PlaceReport {
public:
  explicit PointReport(const std::vector<std::string>& points) : PlaceReport("point,distance") {
    for (const std::string& point : points)
      points_.push_back(parse_point(point));
  }

private:
  void add_rows(const formats::Frame& frame) override {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto nearest = nearest_point(frame, points_[i]);
      const double distance = nearest ? (position_of(frame, *nearest) - points_[i]).norm() : absent;
      add_row(fmt::format("{},{}", i, csv_number(distance)), nearest);
    }
  }

  std::vector<Vector3> points_;
};

} // namespace

std::unique_ptr<Report> make_cut_report(const std::vector<std::string>& planes) {
  return std::make_unique<CutReport>(planes);
}

std::unique_ptr<Report> make_point_report(const std::vector<std::string>& points) {
  return std::make_unique<PointReport>(points);
}

} // namespace sheet
