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

const std::string kHead = "name: test\nrepetitions: 20\n";

TEST(StudySchema, AcceptsWhatTheReaderAccepts) {
  const nlohmann::json schema = StandInSchema();
  for (const std::string& text : {
           kHead,
           kHead + "seed: 9223372036854775807\nindependent_cells: true\n",
           kHead + "sensors: [rgbd]\ndetectors: [paper-rgbd]\n",
           kHead + "detectors:\n  - {name: paper-stereo, label: wide, options: {window_px: 31}}\n"
                   "  - paper-rgbd\n",
           kHead +
               "detectors: [{name: paper-stereo, isolate: true, time_limit_s: 3}, paper-rgbd]\n",
           kHead + "sensors: [stereo]\ndetectors: [{name: mine, command: [python3, mine.py], "
                   "sensor: stereo, options: "
                   "{size_m: 0.8, fast: true, mode: best}, start_limit_s: 20}]\n",
           kHead + "factors: {distance_m: 2, scene: [facade, paper_target], target: true}\n",
           kHead + "factors: {azimuth_deg: {from: 0, to: 40, step: 10}, yaw_deg: {from: 0, to: 1, "
                   "count: 3}}\n",
           kHead + "factors: {yaw_deg: {uniform: [-1, 1]}, roll_deg: {triangular: {min: 0, mode: "
                   "1, max: 3}}, pitch_deg: {normal: {mean: 0, sd: 1}}}\n",
           kHead + "design: sobol\n",
           kHead +
               "design: {method: latin_hypercube, correlations: [{between: [yaw_deg, roll_deg], "
               "spearman: -0.5}]}\nfactors: {yaw_deg: {uniform: [-1, 1]}, roll_deg: {uniform: "
               "[-1, 1]}}\n",
           kHead + "design: {method: sensitivity, causes: {all: [shot, rig, calibration]}}\n",
           kHead + "until: {hit_rate: 0.2, p95_error_mm: 10, first_look: 5}\n",
           std::string("name: test\nrepetitions: 93\nenvelope: {over: distance_m, require: "
                       "{hit_rate: 0.95, p95_error_mm: 50}, confidence: 0.9}\nfactors: "
                       "{distance_m: {from: 1, to: 2, step: 0.1}}\n"),
           kHead + "parts:\n  - name: one\n  - {name: two, repetitions: 3, sensors: [stereo]}\n",
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
           kHead + "sede: 3\n",
           kHead + "seed: -1\n",
           kHead + "seed: 1.5\n",
           kHead + "independent_cells: maybe\n",
           std::string("name: test\nrepetitions: 0\n"),
           std::string("name: test\nrepetitions: 1000001\n"),
           kHead + "sensors: []\n",
           kHead + "sensors: [lidar]\n",
           kHead + "sensors: [stereo, stereo]\n",
           kHead + "detectors: [{name: paper-stereo, isolate: perhaps}]\n",
           kHead + "detectors: [{name: paper-stereo, isolate: true, time_limit_s: 0}]\n",
           kHead + "detectors: [{name: mine, command: python3, sensor: stereo}]\n",
           kHead + "detectors: [{name: mine, command: [python3]}]\n",
           kHead + "detectors: [unknown]\n",
           kHead + "detectors: [{label: nameless}]\n",
           kHead + "detectors: [{name: paper-stereo, options: {window_px: 32}}]\n",
           kHead + "detectors: [{name: paper-stereo, options: {ratio: 0.5}}]\n",
           kHead + "factors: {distnace_m: 2}\n",
           kHead + "factors: {distance_m: -2}\n",
           kHead + "factors: {distance_m: far}\n",
           kHead + "factors: {distance_m: []}\n",
           kHead + "factors: {distance_m: [2, 2]}\n",
           kHead + "factors: {target: 1}\n",
           kHead + "factors: {scene: facede}\n",
           kHead + "factors: {stereo_width_px: 752.5}\n",
           kHead + "factors: {stereo_width_px: {uniform: [100, 200]}}\n",
           kHead + "factors: {yaw_deg: {uniform: [1]}}\n",
           kHead + "factors: {yaw_deg: {uniform: [0, 1], normal: {mean: 0, sd: 1}}}\n",
           kHead + "factors: {yaw_deg: {gaussian: {mean: 0, sd: 1}}}\n",
           kHead + "factors: {yaw_deg: {normal: {mean: 0, sd: 0}}}\n",
           kHead + "factors: {yaw_deg: {from: 0, to: 1}}\n",
           kHead + "factors: {yaw_deg: {from: 0, to: 1, step: 1, count: 2}}\n",
           kHead + "design: sobel\n",
           kHead + "design: {methd: sobol}\n",
           kHead + "design: {correlations: [{between: [yaw_deg], spearman: 0.5}]}\n",
           kHead + "design: {correlations: [{between: [yaw_deg, roll_deg], spearman: 1}]}\n",
           kHead + "design: {method: sensitivity, causes: {noise: [schot]}}\n",
           kHead + "until: {}\n",
           kHead + "until: {hit_rate: 0}\n",
           kHead + "until: {hits: 0.5}\n",
           kHead + "envelope: {over: distance_m}\n",
           kHead + "envelope: {over: distance, require: {hit_rate: 0.9}}\n",
           kHead + "envelope: {over: distance_m, require: {}}\n",
           kHead + "envelope: {over: distance_m, require: {hit_rate: 2}}\n",
           kHead + "parts: []\n",
           kHead + "parts: [{repetitions: 2}]\n",
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
