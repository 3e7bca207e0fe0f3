#include "experiments/output/file_formats.h"

#include <fmt/format.h>

#include "experiments/output/number_format.h"

namespace fenestra {

CsvWriter& CsvWriter::Add(std::string_view field) {
  if (!line_is_empty_) text_ += ',';
  line_is_empty_ = false;
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += field;
    return *this;
  }
  text_ += '"';
  for (const char c : field) {
    if (c == '"') text_ += '"';
    text_ += c;
  }
  text_ += '"';
  return *this;
}

CsvWriter& CsvWriter::Add(std::optional<double> value) {
  return Add(Exact(value));
}

CsvWriter& CsvWriter::Add(int value) {
  return Add(std::to_string(value));
}

CsvWriter& CsvWriter::AddAll(const std::vector<std::string>& fields) {
  for (const std::string& field : fields) Add(field);
  return *this;
}

void CsvWriter::EndLine() {
  text_ += '\n';
  line_is_empty_ = true;
}

std::string ToPcd(std::span<const Eigen::Vector3f> points) {
  std::string file = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
      "TYPE F F F\nCOUNT 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\n"
      "DATA binary\n",
      points.size());
  static_assert(sizeof(Eigen::Vector3f) == 12);
  if (!points.empty()) {
    file.append(reinterpret_cast<const char*>(points.data()), points.size() * 12);
  }
  return file;
}

}  // namespace fenestra
