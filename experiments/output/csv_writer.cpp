#include "experiments/output/csv_writer.h"

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

}  // namespace fenestra
