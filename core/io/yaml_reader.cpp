#include "core/io/yaml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "core/io/input_file.h"

namespace fenestra {
namespace {

constexpr uintmax_t kLargestFile = 4u << 20;

// OpenCV's FileStorage starts its files with "%YAML:1.0", which is not a YAML directive. It
// becomes a comment of the same length, so that positions stay true.
std::string WithoutOpenCvDirective(std::string text) {
  if (text.starts_with("%YAML:")) text[0] = '#';
  return text;
}

std::optional<double> ParseNumber(const std::string& text) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

YamlReader::YamlReader(std::string text, std::string source)
    : text_(std::move(text)), source_(std::move(source)), faults_(source_) {
  const bool blank =
      std::all_of(text_.begin(), text_.end(), [](unsigned char c) { return std::isspace(c) != 0; });
  if (blank) throw InputError(source_, "the file is empty");
  const size_t nul = text_.find('\0');
  if (nul != std::string::npos) {
    const auto line = std::count(text_.begin(), text_.begin() + static_cast<ptrdiff_t>(nul), '\n');
    const size_t line_start = text_.rfind('\n', nul) + 1;  // npos + 1 is 0
    throw InputError({{source_, static_cast<int>(line) + 1, static_cast<int>(nul - line_start) + 1,
                       "not a text file: it contains a NUL byte"}});
  }
  try {
    root_ = YAML::Load(WithoutOpenCvDirective(text_));
  } catch (const YAML::Exception& error) {
    throw InputError(
        {{source_, error.mark.line + 1, error.mark.column + 1, "not valid YAML: " + error.msg}});
  }
}

YamlReader YamlReader::FromFile(const std::filesystem::path& file) {
  return YamlReader(ReadWholeFile(file, kLargestFile), file.string());
}

YamlReader YamlReader::FromText(const std::string& text, const std::string& source) {
  return YamlReader(text, source);
}

void YamlReader::AddFault(const YAML::Node& at, const std::string& message) {
  const YAML::Mark mark = at.IsDefined() ? at.Mark() : YAML::Mark::null_mark();
  faults_.AddFault({.line = mark.line + 1, .column = mark.column + 1, .message = message});
}

void YamlReader::ThrowIfFaulty() {
  faults_.SortByPlace();
  faults_.ThrowIfAny();
}

bool YamlReader::CheckKeys(const YAML::Node& node, const std::string& what,
                           std::span<const std::string> allowed) {
  if (!node.IsMap()) {
    AddFault(node, fmt::format("{} must be a mapping (key: value), not {}", what, Describe(node)));
    return false;
  }
  const size_t before = fault_count();
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : Describe(entry.first);
    if (!seen.insert(key).second) {
      AddFault(entry.first, fmt::format("'{}' stands twice in {}", key, what));
    } else if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      std::string hint = DidYouMean(key, allowed);
      if (hint.empty() && allowed.size() <= 16) {
        hint = fmt::format(" Allowed: {}.", fmt::join(allowed, ", "));
      }
      AddFault(entry.first, fmt::format("unknown key '{}' in {}.{}", key, what, hint));
    }
  }
  return fault_count() == before;
}

std::optional<double> YamlReader::Number(const YAML::Node& node, const std::string& what) {
  if (node.IsScalar() && node.Tag() != "!") {  // "!" marks a quoted scalar: text, not a number.
    if (const auto value = ParseNumber(node.Scalar())) return value;
  }
  AddFault(node, fmt::format("{} must be a finite number, not {}", what, Describe(node)));
  return std::nullopt;
}

std::optional<int64_t> YamlReader::Integer(const YAML::Node& node, const std::string& what,
                                           int64_t min, int64_t max) {
  if (node.IsScalar() && node.Tag() != "!") {
    const std::string& text = node.Scalar();
    int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && value >= min && value <= max) {
      return value;
    }
  }
  AddFault(node, fmt::format("{} must be a whole number from {} to {}, not {}", what, min, max,
                             Describe(node)));
  return std::nullopt;
}

std::optional<bool> YamlReader::Boolean(const YAML::Node& node, const std::string& what) {
  if (node.IsScalar() && node.Tag() != "!") {
    if (node.Scalar() == "true") return true;
    if (node.Scalar() == "false") return false;
  }
  AddFault(node, fmt::format("{} must be true or false, not {}", what, Describe(node)));
  return std::nullopt;
}

std::optional<std::string> YamlReader::Text(const YAML::Node& node, const std::string& what) {
  if (node.IsScalar()) return node.Scalar();
  AddFault(node, fmt::format("{} must be text, not {}", what, Describe(node)));
  return std::nullopt;
}

std::optional<std::vector<double>> YamlReader::Numbers(const YAML::Node& node,
                                                       const std::string& what, size_t count) {
  if (!node.IsSequence() || (count != 0 && node.size() != count)) {
    const std::string size = count == 0 ? "" : fmt::format("{} ", count);
    AddFault(node,
             fmt::format("{} must be a list of {}numbers, not {}", what, size, Describe(node)));
    return std::nullopt;
  }
  std::vector<double> values;
  for (const YAML::Node& item : node) {
    const auto value = Number(item, "each entry of " + what);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::string YamlReader::Describe(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) return "nothing";
  if (node.IsMap()) return "a mapping";
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  const std::string& text = node.Scalar();
  return text.size() <= 40 ? "'" + text + "'" : "'" + text.substr(0, 40) + "…'";
}

std::string YamlQuoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

}  // namespace fenestra
