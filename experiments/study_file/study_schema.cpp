#include "experiments/study_file/study_schema.h"

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "core/system/check.h"
#include "experiments/study/metric.h"
#include "experiments/study_file/design_reader.h"
#include "experiments/study_file/detector_reader.h"
#include "experiments/study_file/factor_reader.h"
#include "experiments/study_file/part_reader.h"
#include "experiments/study_file/rule_reader.h"
#include "experiments/study_file/study_blocks.h"
#include "experiments/study_file/study_reader.h"

namespace fenestra {
namespace {

using Json = nlohmann::ordered_json;

// [a-z0-9_-], as ReadName demands.
const Json kName = {{"type", "string"}, {"pattern", "^[a-z0-9_-]{1,64}$"}};

// A mapping with exactly the keys that the reader knows: a key without a schema, or a schema
// without a key, is a fault of this program.
Json Mapping(const std::vector<std::string>& keys, const std::map<std::string, Json>& schemas,
             const std::vector<std::string>& required = {}) {
  Json properties = Json::object();
  for (const std::string& key : keys) {
    FENESTRA_CHECK(schemas.contains(key), "a key without a schema: " + key);
    properties[key] = schemas.at(key);
  }
  FENESTRA_CHECK(schemas.size() == keys.size(), "a schema without a key");
  Json mapping = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) mapping["required"] = required;
  return mapping;
}

Json Described(Json schema, const std::string& description) {
  schema["description"] = description;
  return schema;
}

Json ValueOf(const ParameterValue& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

Json NumberOf(const ParameterInfo& parameter) {
  Json number = {{"type", parameter.type == ParameterInfo::Type::kInteger ? "integer" : "number"}};
  if (std::isfinite(parameter.min)) number["minimum"] = parameter.min;
  if (std::isfinite(parameter.max)) number["maximum"] = parameter.max;
  return number;
}

Json ValueSchema(const ParameterInfo& parameter) {
  switch (parameter.type) {
    case ParameterInfo::Type::kSwitch:
      return {{"type", "boolean"}};
    case ParameterInfo::Type::kChoice:
      return {{"enum", parameter.choices}};
    case ParameterInfo::Type::kNumber:
    case ParameterInfo::Type::kInteger:
      return NumberOf(parameter);
  }
  FENESTRA_CHECK(false, "parameter type out of range");
}

Json RangeSchema(const Json& number) {
  const Json positive = {{"type", "number"}, {"exclusiveMinimum", 0}};
  const Json count = {{"type", "integer"}, {"minimum", 2}, {"maximum", kMostCells}};
  Json range =
      Mapping(kRangeKeys, {{"from", number}, {"to", number}, {"step", positive}, {"count", count}},
              {"from", "to"});
  range["oneOf"] = {{{"required", {"step"}}}, {{"required", {"count"}}}};
  return range;
}

Json DistributionSchema(const Json& number) {
  const Json pair = {{"type", "array"}, {"items", number}, {"minItems", 2}, {"maxItems", 2}};
  const Json any = {{"type", "number"}};
  const Json positive = {{"type", "number"}, {"exclusiveMinimum", 0}};
  const Json triangular =
      Mapping({"min", "mode", "max"}, {{"min", number}, {"mode", number}, {"max", number}},
              {"min", "mode", "max"});
  const Json normal =
      Mapping({"mean", "sd", "min", "max"},
              {{"mean", any}, {"sd", positive}, {"min", number}, {"max", number}}, {"mean", "sd"});
  Json distribution = Mapping(
      kDistributionKeys,
      {{"uniform", pair}, {"log_uniform", pair}, {"triangular", triangular}, {"normal", normal}});
  distribution["minProperties"] = 1;
  distribution["maxProperties"] = 1;
  return distribution;
}

Json FactorSchema(const ParameterInfo& factor) {
  const Json value = ValueSchema(factor);
  Json forms = {value,
                {{"type", "array"}, {"items", value}, {"minItems", 1}, {"uniqueItems", true}}};
  const bool integer = factor.type == ParameterInfo::Type::kInteger;
  const bool number = factor.type == ParameterInfo::Type::kNumber;
  if (integer || number) forms.push_back(RangeSchema(value));
  if (number) forms.push_back(DistributionSchema(value));
  Json schema = {{"description", factor.description + " (" + factor.Allowed() + ")"},
                 {"default", ValueOf(WrittenDefault(factor))},
                 {"anyOf", forms}};
  return schema;
}

Json FactorsSchema() {
  Json properties = Json::object();
  for (const ParameterInfo& factor : Factors().infos()) {
    properties[factor.name] = FactorSchema(factor);
  }
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

Json OptionsSchema(const DetectorInfo& detector) {
  Json properties = Json::object();
  for (const ParameterInfo& option : detector.options) {
    Json schema = Described(ValueSchema(option), option.description);
    schema["default"] = ValueOf(WrittenDefault(option));
    properties[option.name] = schema;
  }
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

Json LimitSchema(double default_s) {
  return {{"type", "number"},
          {"exclusiveMinimum", 0},
          {"maximum", kLongestLimit_s},
          {"default", default_s}};
}

const Json& SensorSchema() {
  static const Json sensor = {
      {"enum", {ToString(SensorKind::kStereo), ToString(SensorKind::kRgbd)}}};
  return sensor;
}

// A program of the user's own; its options are handed over as they are.
Json ProgramSchema() {
  const Json words = {{"type", "array"}, {"items", {{"type", "string"}}}, {"minItems", 1}};
  const Json options = {
      {"type", "object"},
      {"additionalProperties",
       {{"anyOf", {{{"type", "boolean"}}, {{"type", "number"}}, {{"type", "string"}}}}}}};
  return Described(Mapping(kProgramKeys,
                           {{"name", kName},
                            {"label", kName},
                            {"command", words},
                            {"sensor", SensorSchema()},
                            {"options", options},
                            {"time_limit_s", LimitSchema(DetectorProcess{}.time_limit_s)},
                            {"start_limit_s", LimitSchema(DetectorProcess{}.start_limit_s)}},
                           {"name", "command", "sensor"}),
                   "A program of your own.");
}

Json DetectorsSchema(std::span<const DetectorInfo> known) {
  std::vector<std::string> names;
  Json forms = Json::array();
  for (const DetectorInfo& detector : known) {
    names.push_back(detector.name);
    forms.push_back(
        Described(Mapping(kDetectorKeys,
                          {{"name", {{"const", detector.name}}},
                           {"label", kName},
                           {"options", OptionsSchema(detector)},
                           {"isolate", {{"type", "boolean"}}},
                           {"time_limit_s", LimitSchema(DetectorProcess{}.time_limit_s)},
                           {"start_limit_s", LimitSchema(DetectorProcess{}.start_limit_s)}},
                          {"name"}),
                  detector.description));
  }
  forms.push_back(ProgramSchema());
  forms.insert(forms.begin(), Json{{"enum", names}});
  return {{"type", "array"}, {"items", {{"anyOf", forms}}}, {"minItems", 1}};
}

Json CorrelationSchema(const Json& factor) {
  const Json between = {{"type", "array"}, {"items", factor}, {"minItems", 2}, {"maxItems", 2}};
  const Json rho = {{"type", "number"}, {"minimum", -0.999}, {"maximum", 0.999}};
  return Mapping(kCorrelationKeys, {{"between", between}, {"spearman", rho}}, kCorrelationKeys);
}

Json DesignSchema() {
  std::vector<std::string> methods;
  for (const DesignMethod method : kAllDesignMethods) methods.push_back(ToString(method));
  std::vector<std::string> factors = Factors().Names();
  std::vector<std::string> sources{kShotSource, kRigSource, kCalibrationSource};
  sources.insert(sources.end(), factors.begin(), factors.end());
  const Json method = {{"enum", methods}, {"default", ToString(DesignMethod::kMonteCarlo)}};
  const Json correlations = {{"type", "array"}, {"items", CorrelationSchema({{"enum", factors}})}};
  const Json cause = {{"type", "array"}, {"items", {{"enum", sources}}}, {"minItems", 1}};
  const Json causes = {{"type", "object"}, {"additionalProperties", cause}, {"minProperties", 1}};
  return {{"anyOf",
           {method,
            Mapping(kDesignKeys,
                    {{"method", method}, {"correlations", correlations}, {"causes", causes}})}}};
}

Json UntilSchema() {
  std::map<std::string, Json> schemas;
  for (const std::string& key : StoppingKeys()) {
    schemas[key] = {{"type", "number"}, {"exclusiveMinimum", 0}};
  }
  schemas["first_look"] = {{"type", "integer"}, {"minimum", 1}, {"default", 20}};
  Json until = Mapping(StoppingKeys(), schemas);
  until["minProperties"] = 1;
  return until;
}

Json EnvelopeSchema() {
  const Json share = {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 1}};
  const Json length = {{"type", "number"}, {"exclusiveMinimum", 0}};
  std::map<std::string, Json> demands;
  for (const std::string& name : RequirementMetrics()) {
    demands[name] = FindMetric(name)->IsShare() ? share : length;
  }
  Json require = Mapping(RequirementMetrics(), demands);
  require["minProperties"] = 1;
  return Mapping(kEnvelopeKeys,
                 {{"over", {{"enum", Factors().Names()}}},
                  {"require", require},
                  {"confidence", {{"type", "number"}, {"exclusiveMinimum", 0.5}, {"maximum", 1}}}},
                 {"over", "require"});
}

std::map<std::string, Json> BlockSchemas(std::span<const DetectorInfo> known) {
  return {
      {"repetitions",
       {{"type", "integer"},
        {"minimum", 1},
        {"maximum", kMostTrials},
        {"description", "Trials of each cell."}}},
      {"sensors",
       {{"type", "array"},
        {"items", SensorSchema()},
        {"minItems", 1},
        {"uniqueItems", true},
        {"description", "Default: both."}}},
      {"detectors", Described(DetectorsSchema(known), "Default: every detector of the sensors.")},
      {"design", Described(DesignSchema(), "How trials are spread over what is drawn.")},
      {"until", Described(UntilSchema(), "Widths of intervals at which a cell has enough trials.")},
      {"envelope",
       Described(EnvelopeSchema(), "A search for the levels where a requirement holds.")},
      {"factors", Described(FactorsSchema(),
                            "A value, a list or a range of levels, or a "
                            "distribution.")},
  };
}

}  // namespace

std::string StudySchema(std::span<const DetectorInfo> known_detectors) {
  const std::map<std::string, Json> block = BlockSchemas(known_detectors);
  Json references;
  std::map<std::string, Json> by_reference;
  for (const auto& [key, schema] : block) {
    references[key] = schema;
    by_reference[key] = {{"$ref", "#/definitions/" + key}};
  }
  std::map<std::string, Json> part = by_reference;
  part["name"] = kName;
  std::map<std::string, Json> study = part;
  study["fenestra_version"] = {{"description", "Which version resolved the study."}};
  study["description"] = {{"type", "string"}};
  study["seed"] = {{"type", "integer"},
                   {"minimum", 0},
                   {"maximum", std::numeric_limits<int64_t>::max()},
                   {"default", 1}};
  study["independent_cells"] = {{"type", "boolean"}, {"default", false}};
  study["parts"] = {
      {"type", "array"}, {"items", Mapping(PartKeys(), part, {"name"})}, {"minItems", 1}};
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "Fenestra study"},
                 {"definitions", references}};
  schema.update(Mapping(StudyKeys(), study, {"name"}));
  return schema.dump(1) + "\n";
}

}  // namespace fenestra
