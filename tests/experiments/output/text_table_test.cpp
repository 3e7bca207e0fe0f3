#include "experiments/output/text_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/experiments/report/report_examples.h"

namespace fenestra {
namespace {

using testing::Lines;

TEST(TextTable, AlignsByCharactersNotBytes) {
  TextTable table;
  table.AddColumn("größe", TextTable::Align::kLeft);
  table.AddColumn("n");
  table.AddRow({"—", "1000"});
  table.AddRow({"1.2 ± 0.3", "7"});
  const std::vector<std::string> lines = Lines(table.ToPlainText());
  ASSERT_EQ(lines.size(), 4u);
  for (const std::string& line : lines) EXPECT_EQ(DisplayWidth(line), 15u) << line;
  EXPECT_THROW(table.AddRow({"too few"}), std::logic_error);
}

}  // namespace
}  // namespace fenestra
