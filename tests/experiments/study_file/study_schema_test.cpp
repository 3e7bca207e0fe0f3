#include "experiments/study_file/study_schema.h"

#include <gtest/gtest.h>

#include "experiments/study_file/study_catalogue.h"
#include "experiments/study_file/study_writer.h"
#include "tests/experiments/study_file/study_text.h"
#include "tests/support/json_schema.h"

namespace fenestra {
namespace {

std::vector<std::string> FaultsBySchema(const nlohmann::json& schema, const std::string& text) {
  return SchemaFaults(schema, ToJson(YAML::Load(text)));
}

nlohmann::json StandInSchema() {
  return nlohmann::json::parse(StudySchema(StandInDetectors()));
}

TEST(StudySchema, AcceptsEveryStudyThatComesAlong) {
  const auto schema = nlohmann::json::parse(StudySchema(Detectors()));
  for (const std::string& name : BuiltInStudies()) {
    const YamlReader reader = YamlReader::FromFile(FindStudy(name));
    EXPECT_EQ(FaultsBySchema(schema, reader.text()), std::vector<std::string>{}) << name;
    const std::string resolved = ToYaml(ReadStudy(reader, Detectors()));
    EXPECT_EQ(FaultsBySchema(schema, resolved), std::vector<std::string>{}) << name;
  }
}

const std::string kSchemaHead = "name: test\nrepetitions: 20\n";

TEST(StudySchema, AcceptsWhatTheReaderAccepts) {
  const nlohmann::json schema = StandInSchema();
  for (const std::string& text : {
           kSchemaHead,
           kSchemaHead + "seed: 9223372036854775807\nindependent_cells: true\n",
           kSchemaHead + "sensors: [rgbd]\ndetectors: [paper-rgbd]\n",
           kSchemaHead +
               "detectors:\n  - {name: paper-stereo, label: wide, options: {window_px: 31}}\n"
               "  - paper-rgbd\n",
           kSchemaHead +
               "detectors: [{name: paper-stereo, isolate: true, time_limit_s: 3}, paper-rgbd]\n",
           kSchemaHead + "sensors: [stereo]\ndetectors: [{name: mine, command: [python3, mine.py], "
                         "sensor: stereo, options: "
                         "{size_m: 0.8, fast: true, mode: best}, start_limit_s: 20}]\n",
           kSchemaHead + "factors: {distance_m: 2, scene: [facade, paper_target], target: true}\n",
           kSchemaHead +
               "factors: {azimuth_deg: {from: 0, to: 40, step: 10}, yaw_deg: {from: 0, to: 1, "
               "count: 3}}\n",
           kSchemaHead +
               "factors: {yaw_deg: {uniform: [-1, 1]}, roll_deg: {triangular: {min: 0, mode: "
               "1, max: 3}}, pitch_deg: {normal: {mean: 0, sd: 1}}}\n",
           kSchemaHead + "design: sobol\n",
           kSchemaHead +
               "design: {method: latin_hypercube, correlations: [{between: [yaw_deg, roll_deg], "
               "spearman: -0.5}]}\nfactors: {yaw_deg: {uniform: [-1, 1]}, roll_deg: {uniform: "
               "[-1, 1]}}\n",
           kSchemaHead + "design: {method: sensitivity, causes: {all: [shot, rig, calibration]}}\n",
           kSchemaHead + "until: {hit_rate: 0.2, p95_error_mm: 10, first_look: 5}\n",
           std::string("name: test\nrepetitions: 93\nenvelope: {over: distance_m, require: "
                       "{hit_rate: 0.95, p95_error_mm: 50}, confidence: 0.9}\nfactors: "
                       "{distance_m: {from: 1, to: 2, step: 0.1}}\n"),
           kSchemaHead +
               "parts:\n  - name: one\n  - {name: two, repetitions: 3, sensors: [stereo]}\n",
       }) {
    EXPECT_EQ(FaultsOf(text), std::vector<std::string>{}) << text;
    EXPECT_EQ(FaultsBySchema(schema, text), std::vector<std::string>{}) << text;
  }
}

TEST(StudySchema, RefusesWhatTheReaderRefuses) {
  const nlohmann::json schema = StandInSchema();
  for (const std::string& text : {
           std::string("repetitions: 2\n"),
           std::string("name: Not A Name\nrepetitions: 2\n"),
           kSchemaHead + "sede: 3\n",
           kSchemaHead + "seed: -1\n",
           kSchemaHead + "seed: 1.5\n",
           kSchemaHead + "independent_cells: maybe\n",
           std::string("name: test\nrepetitions: 0\n"),
           std::string("name: test\nrepetitions: 1000001\n"),
           kSchemaHead + "sensors: []\n",
           kSchemaHead + "sensors: [lidar]\n",
           kSchemaHead + "sensors: [stereo, stereo]\n",
           kSchemaHead + "detectors: [{name: paper-stereo, isolate: perhaps}]\n",
           kSchemaHead + "detectors: [{name: paper-stereo, isolate: true, time_limit_s: 0}]\n",
           kSchemaHead + "detectors: [{name: mine, command: python3, sensor: stereo}]\n",
           kSchemaHead + "detectors: [{name: mine, command: [python3]}]\n",
           kSchemaHead + "detectors: [unknown]\n",
           kSchemaHead + "detectors: [{label: nameless}]\n",
           kSchemaHead + "detectors: [{name: paper-stereo, options: {window_px: 32}}]\n",
           kSchemaHead + "detectors: [{name: paper-stereo, options: {ratio: 0.5}}]\n",
           kSchemaHead + "factors: {distnace_m: 2}\n",
           kSchemaHead + "factors: {distance_m: -2}\n",
           kSchemaHead + "factors: {distance_m: far}\n",
           kSchemaHead + "factors: {distance_m: []}\n",
           kSchemaHead + "factors: {distance_m: [2, 2]}\n",
           kSchemaHead + "factors: {target: 1}\n",
           kSchemaHead + "factors: {scene: facede}\n",
           kSchemaHead + "factors: {stereo_width_px: 752.5}\n",
           kSchemaHead + "factors: {stereo_width_px: {uniform: [100, 200]}}\n",
           kSchemaHead + "factors: {yaw_deg: {uniform: [1]}}\n",
           kSchemaHead + "factors: {yaw_deg: {uniform: [0, 1], normal: {mean: 0, sd: 1}}}\n",
           kSchemaHead + "factors: {yaw_deg: {gaussian: {mean: 0, sd: 1}}}\n",
           kSchemaHead + "factors: {yaw_deg: {normal: {mean: 0, sd: 0}}}\n",
           kSchemaHead + "factors: {yaw_deg: {from: 0, to: 1}}\n",
           kSchemaHead + "factors: {yaw_deg: {from: 0, to: 1, step: 1, count: 2}}\n",
           kSchemaHead + "design: sobel\n",
           kSchemaHead + "design: {methd: sobol}\n",
           kSchemaHead + "design: {correlations: [{between: [yaw_deg], spearman: 0.5}]}\n",
           kSchemaHead + "design: {correlations: [{between: [yaw_deg, roll_deg], spearman: 1}]}\n",
           kSchemaHead + "design: {method: sensitivity, causes: {noise: [schot]}}\n",
           kSchemaHead + "until: {}\n",
           kSchemaHead + "until: {hit_rate: 0}\n",
           kSchemaHead + "until: {hits: 0.5}\n",
           kSchemaHead + "envelope: {over: distance_m}\n",
           kSchemaHead + "envelope: {over: distance, require: {hit_rate: 0.9}}\n",
           kSchemaHead + "envelope: {over: distance_m, require: {}}\n",
           kSchemaHead + "envelope: {over: distance_m, require: {hit_rate: 2}}\n",
           kSchemaHead + "parts: []\n",
           kSchemaHead + "parts: [{repetitions: 2}]\n",
       }) {
    EXPECT_NE(FaultsOf(text), std::vector<std::string>{}) << text;
    EXPECT_NE(FaultsBySchema(schema, text), std::vector<std::string>{}) << text;
  }
}

TEST(StudySchema, HasEveryFactorWithItsRangeAndDefault) {
  const nlohmann::json schema = StandInSchema();
  const auto& factors = schema.at("definitions").at("factors").at("properties");
  EXPECT_EQ(factors.size(), Factors().infos().size());
  EXPECT_EQ(factors.at("distance_m").at("anyOf").at(0).at("maximum"), 100);
  EXPECT_EQ(factors.at("scene").at("default"), "paper_target");
}

}  // namespace
}  // namespace fenestra
