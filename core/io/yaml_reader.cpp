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

// OpenCV's FileStorage starts its documents with "%YAML:1.0", which is not a YAML directive. It
// becomes a comment of the same length, so that positions stay true.
std::string WithoutOpenCvDirectives(std::string text) {
  const std::string directive = "%YAML:";
  for (size_t at = text.find(directive); at != std::string::npos; at = text.find(directive, at)) {
    text[at] = at == 0 || text[at - 1] == '\n' ? '#' : text[at];
    ++at;
  }
  return text;
}

std::optional<double> ParseNumber(const std::string& text) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (last - first > 1 && *first == '+' && first[1] != '-') ++first;
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

// Of the byte at `offset`, with a message.
InputFault FaultAt(const std::string& source, const std::string& text, size_t offset,
                   std::string message) {
  const auto line = std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(offset), '\n');
  const size_t line_start = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;  // npos + 1 is 0
  return {source, static_cast<int>(line) + 1, static_cast<int>(offset - line_start) + 1,
          std::move(message)};
}

// Of YAML, in which JSON is contained.
std::optional<InputFault> NotText(const std::string& text, const std::string& source) {
  if (const size_t nul = text.find('\0'); nul != std::string::npos) {
    return FaultAt(source, text, nul, "not a text file: it contains a NUL byte");
  }
  if (const auto bad = FirstNotUtf8(text)) {
    return FaultAt(source, text, *bad,
                   fmt::format("not UTF-8 text: the byte 0x{:02x} is out of place; save the file "
                               "as UTF-8",
                               static_cast<unsigned char>(text[*bad])));
  }
  if (text.starts_with("<?xml")) return InputFault{source, 1, 1, "XML; YAML and JSON are read"};
  return std::nullopt;
}

}  // namespace

YamlReader::YamlReader(std::string text, std::string source)
    : text_(std::move(text)), source_(std::move(source)), faults_(source_) {
  const bool blank =
      std::all_of(text_.begin(), text_.end(), [](unsigned char c) { return std::isspace(c) != 0; });
  if (blank) throw InputError(source_, "the file is empty");
  if (const auto fault = NotText(text_, source_)) throw InputError({*fault});
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(WithoutOpenCvDirectives(text_));
    if (documents.size() > 1) {
      const YAML::Mark mark = documents[1].Mark();
      throw InputError({{source_, mark.line + 1, mark.column + 1,
                         "more than one document: what follows the line '---' or '...' would not "
                         "be read"}});
    }
    if (!documents.empty()) root_ = documents.front();
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
