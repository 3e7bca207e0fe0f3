#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fenestra {

/// A table of texts whose columns are aligned, for a terminal or in Markdown.
class TextTable {
 public:
  enum class Align { kLeft, kRight };

  void AddColumn(const std::string& heading, Align align = Align::kRight);
  /// One text for each column.
  void AddRow(std::vector<std::string> cells);

  bool empty() const { return rows_.empty(); }

  /// Headings, a rule and the rows; every line has the same width in characters, apart from
  /// trailing blanks, which are cut.
  std::string ToPlainText() const;
  /// A table of GitHub-flavoured Markdown, aligned in its source, too. "|" and line breaks in a
  /// cell are escaped.
  std::string ToMarkdown() const;

 private:
  struct Column {
    std::string heading;
    Align align;
  };

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// How many characters the UTF-8 text shows: its code points. (Combining and double-width
/// characters are not told apart.)
size_t DisplayWidth(std::string_view text);

}  // namespace fenestra
