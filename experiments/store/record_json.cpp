#include "experiments/store/record_json.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/detection/detection_json.h"

namespace fenestra {
namespace {

// nlohmann-json writes a double in the shortest form that reads back exactly, -0.0 included.
using Json = nlohmann::ordered_json;

Json ValueToJson(const ParameterValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag;
  if (const std::string* word = std::get_if<std::string>(&value)) return *word;
  const double number = std::get<double>(value);
  if (std::isfinite(number)) return number;
  return Json{{"number", fmt::format("{}", number)}};
}

ParameterValue ToParameterValue(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_number()) return json.get<double>();
  return std::strtod(json.at("number").get_ref<const std::string&>().c_str(), nullptr);
}

Eigen::Vector3d ToVector(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

/// read(json), with nlohmann-json's exceptions translated.
auto Parse(const std::string& text, const auto& read) {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& exception) {
    throw std::runtime_error(exception.what());
  }
}

void RequireObject(const Json& json) {
  if (!json.is_object()) throw std::runtime_error("not a JSON object: " + json.dump());
}

/// Names come from studies and detectors, which have checked them; a byte that is not UTF-8 in one
/// of them must not cost the trial.
std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string FactorsToJson(const FactorValues& factors) {
  Json json = Json::object();
  for (const auto& [name, value] : factors) {
    FENESTRA_CHECK(!json.contains(name), "factor named twice: " + name);
    json[name] = ValueToJson(value);
  }
  return Dump(json);
}

FactorValues FactorsFromJson(const std::string& text) {
  return Parse(text, [](const Json& json) {
    RequireObject(json);
    FactorValues factors;
    for (const auto& [name, value] : json.items()) {
      factors.emplace_back(name, ToParameterValue(value));
    }
    return factors;
  });
}

std::string StageTimesToJson(const std::vector<StageTime>& stages) {
  Json json = Json::object();
  for (const StageTime& stage : stages) {
    FENESTRA_CHECK(!json.contains(stage.stage), "stage named twice: " + stage.stage);
    FENESTRA_CHECK(std::isfinite(stage.seconds), "time of stage " + stage.stage);
    json[stage.stage] = stage.seconds;
  }
  return Dump(json);
}

std::vector<StageTime> StageTimesFromJson(const std::string& text) {
  return Parse(text, [](const Json& json) {
    RequireObject(json);
    std::vector<StageTime> stages;
    for (const auto& [stage, seconds] : json.items()) {
      stages.push_back({stage, seconds.get<double>()});
    }
    return stages;
  });
}

std::string CornersToJson(const std::array<Eigen::Vector3d, 4>& corners) {
  return Dump(ToJson(corners));
}

std::array<Eigen::Vector3d, 4> CornersFromJson(const std::string& text) {
  return Parse(text, [](const Json& json) {
    std::array<Eigen::Vector3d, 4> corners;
    for (size_t i = 0; i < 4; ++i) corners[i] = ToVector(json.at(i));
    return corners;
  });
}

std::string MatrixToJson(const Eigen::Matrix3d& matrix) {
  return Dump(ToJson(matrix));
}

Eigen::Matrix3d MatrixFromJson(const std::string& text) {
  return Parse(text, [](const Json& json) {
    Eigen::Matrix3d matrix;
    for (size_t row = 0; row < 3; ++row) {
      matrix.row(static_cast<Eigen::Index>(row)) = ToVector(json.at(row)).transpose();
    }
    return matrix;
  });
}

}  // namespace fenestra
