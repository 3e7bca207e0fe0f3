#include "experiments/output/text_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/system/check.h"

namespace fenestra {
namespace {

std::string Repeat(std::string_view text, size_t count) {
  std::string result;
  for (size_t i = 0; i < count; ++i) result += text;
  return result;
}

std::string Pad(const std::string& text, size_t width, TextTable::Align align) {
  const std::string blanks(width - DisplayWidth(text), ' ');
  return align == TextTable::Align::kLeft ? text + blanks : blanks + text;
}

std::string EscapeMarkdown(const std::string& cell) {
  std::string escaped;
  for (const char c : cell) {
    if (c == '|') {
      escaped += "\\|";
    } else if (c == '\n' || c == '\r') {
      escaped += ' ';
    } else {
      escaped += c;
    }
  }
  return escaped;
}

void CutTrailingBlanks(std::string& line) {
  line.erase(line.find_last_not_of(' ') + 1);
}

}  // namespace

size_t DisplayWidth(std::string_view text) {
  // Continuation bytes are 10xxxxxx.
  return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

void TextTable::AddColumn(const std::string& heading, Align align) {
  FENESTRA_CHECK(rows_.empty(), "columns come before rows");
  columns_.push_back({heading, align});
}

void TextTable::AddRow(std::vector<std::string> cells) {
  FENESTRA_CHECK(cells.size() == columns_.size(),
                 fmt::format("{} cells in {} columns", cells.size(), columns_.size()));
  rows_.push_back(std::move(cells));
}

std::string TextTable::ToPlainText() const {
  std::vector<size_t> widths;
  for (size_t i = 0; i < columns_.size(); ++i) {
    widths.push_back(DisplayWidth(columns_[i].heading));
    for (const auto& row : rows_) widths[i] = std::max(widths[i], DisplayWidth(row[i]));
  }
  std::string head;
  std::string rule;
  for (size_t i = 0; i < columns_.size(); ++i) {
    head += (i > 0 ? "  " : "") + Pad(columns_[i].heading, widths[i], columns_[i].align);
    rule += (i > 0 ? "  " : "") + Repeat("─", widths[i]);
  }
  CutTrailingBlanks(head);
  std::string text = head + "\n" + rule + "\n";
  for (const auto& row : rows_) {
    std::string line;
    for (size_t i = 0; i < columns_.size(); ++i) {
      line += (i > 0 ? "  " : "") + Pad(row[i], widths[i], columns_[i].align);
    }
    CutTrailingBlanks(line);
    text += line + "\n";
  }
  return text;
}

std::string TextTable::ToMarkdown() const {
  std::vector<std::vector<std::string>> lines(1);
  for (const Column& column : columns_) lines[0].push_back(EscapeMarkdown(column.heading));
  for (const auto& row : rows_) {
    lines.emplace_back();
    for (const std::string& cell : row) lines.back().push_back(EscapeMarkdown(cell));
  }
  std::vector<size_t> widths(columns_.size(), 3);  // The shortest rule, "---".
  for (const auto& line : lines) {
    for (size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], DisplayWidth(line[i]));
  }
  std::string text;
  for (size_t k = 0; k < lines.size(); ++k) {
    for (size_t i = 0; i < columns_.size(); ++i) {
      text += "| " + Pad(lines[k][i], widths[i], columns_[i].align) + " ";
    }
    text += "|\n";
    if (k > 0) continue;
    for (size_t i = 0; i < columns_.size(); ++i) {
      const bool left = columns_[i].align == Align::kLeft;
      text +=
          "|" + std::string(left ? ":" : "-") + std::string(widths[i], '-') + (left ? "-" : ":");
    }
    text += "|\n";
  }
  return text;
}

}  // namespace fenestra
