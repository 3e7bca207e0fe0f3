#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace fenestra::testing {

using CsvLine = std::vector<std::string>;

/// A reader of RFC 4180 that knows nothing of the writer.
inline std::vector<CsvLine> ParseCsv(const std::string& text) {
  std::vector<CsvLine> lines(1, CsvLine(1));
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        lines.back().back() += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        lines.back().back() += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      lines.back().emplace_back();
    } else if (c == '\n') {
      lines.emplace_back(1);
    } else {
      lines.back().back() += c;
    }
  }
  lines.pop_back();  // After the last line feed.
  return lines;
}

/// Lines by column name.
inline std::vector<std::map<std::string, std::string>> ParseTable(const std::string& text) {
  const std::vector<CsvLine> lines = ParseCsv(text);
  std::vector<std::map<std::string, std::string>> table;
  for (size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].size(), lines[0].size()) << "line " << i;
    table.emplace_back();
    for (size_t k = 0; k < lines[0].size(); ++k) table.back()[lines[0][k]] = lines[i].at(k);
    EXPECT_EQ(table.back().size(), lines[0].size()) << "a column occurs twice";
  }
  return table;
}

inline double ToNumber(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

}  // namespace fenestra::testing
