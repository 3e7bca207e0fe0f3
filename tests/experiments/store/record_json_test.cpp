#include "experiments/store/record_json.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace fenestra {
namespace {

TEST(RecordJson, ForeignTextIsAnError) {
  for (const char* text : {"", "{", "[1]", "3", "{\"a\": null}", "{\"a\": [1]}"}) {
    EXPECT_THROW(FactorsFromJson(text), std::runtime_error) << text;
    EXPECT_THROW(StageTimesFromJson(text), std::runtime_error) << text;
    EXPECT_THROW(CornersFromJson(text), std::runtime_error) << text;
    EXPECT_THROW(MatrixFromJson(text), std::runtime_error) << text;
  }
}

}  // namespace
}  // namespace fenestra
