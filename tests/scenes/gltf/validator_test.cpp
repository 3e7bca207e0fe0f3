#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "tests/scenes/gltf/gltf_text.h"

// The Khronos validator's own test files: what it finds wrong is refused, what it accepts is read.

namespace fenestra {
namespace {

using testing::GltfData;

// Why we do not do as the validator does. Animations are left out, so what only spoils their
// movement is none of our business; their references are checked all the same.
const std::map<std::string, std::string> kReasonToAccept = {
    {"base/data/animation/channel_duplicate_targets.gltf", "movement"},
    {"base/data/animation/channel_node_no_morphs.gltf", "movement"},
    {"base/data/animation/sampler_bufferview_bytestride.gltf", "movement"},
    {"base/data/animation/sampler_input_no_bounds.gltf", "movement"},
    {"base/data/animation/sampler_output_format_invalid.gltf", "movement"}};

const std::map<std::string, std::string> kReasonToRefuse = {
    {"base/data/asset/min_version_valid.gltf", "it demands a reader of glTF 2.1"},
    {"base/data/buffer/non_relative_uri.gltf", "nothing is fetched from the network"},
    {"base/data/image/custom_property.gltf", "magenta.png is not among the files"},
    {"base/data/image/valid.gltf", "magenta.png is not among the files"},
    {"base/data/mesh_data/index_buffer_degenerate_triangle.gltf",
     "its .bin is not among the files"}};

struct Row {
  std::string file;
  int errors = 0;
};

std::vector<Row> ExpectedRows() {
  std::ifstream table(GltfData() / "validator/expected.tsv");
  std::string line;
  std::getline(table, line);  // The heading.
  std::vector<Row> rows;
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    Row& row = rows.emplace_back();
    std::getline(fields, row.file, '\t');
    fields >> row.errors;
  }
  return rows;
}

TEST(GltfValidatorFiles, WhatTheValidatorRefusesIsRefusedAndNothingElse) {
  size_t valid = 0;
  size_t invalid = 0;
  for (const Row& row : ExpectedRows()) {
    const std::string refusal = testing::Refusal(GltfData() / "validator" / row.file);
    const bool should_be_read =
        row.errors == 0 ? !kReasonToRefuse.contains(row.file) : kReasonToAccept.contains(row.file);
    EXPECT_EQ(refusal.empty(), should_be_read) << row.file << "\n" << refusal;
    ++(row.errors == 0 ? valid : invalid);
  }
  EXPECT_EQ(valid, 48u);
  EXPECT_EQ(invalid, 103u);
}

TEST(GltfValidatorFiles, RegressionFilesOfTinygltfAreErrorsAndNotCrashes) {
  const auto folder = GltfData() / "tinygltf";
  for (const char* file :
       {"BoundsChecking/invalid-buffer-index.gltf", "BoundsChecking/invalid-buffer-view-index.gltf",
        "BoundsChecking/invalid-primitive-indices.gltf",
        "BoundsChecking/integer-out-of-bounds.gltf",
        "regression/unassigned-skeleton.gltf"}) {  // Its bind matrices are noise.
    EXPECT_NE(testing::Refusal(folder / file), "") << file;
  }
  EXPECT_EQ(testing::Refusal(folder / "regression/zero-sized-bin-chunk-issue-440.glb"), "");
}

}  // namespace
}  // namespace fenestra
