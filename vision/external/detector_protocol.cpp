#include "vision/external/detector_protocol.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/detection/detector.h"
#include "vision/external/child_process.h"

namespace fenestra {
namespace {

using Json = nlohmann::ordered_json;

// Objects of ordered_json are searched linearly, so a line that consists of keys would take
// minutes.
constexpr int kMostKeys = 5000;

std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json ParseObject(std::string_view line) {
  int keys = 0;
  const auto count = [&keys](int, Json::parse_event_t event, Json&) {
    if (event == Json::parse_event_t::key && ++keys > kMostKeys) {
      throw DetectorFailure("bad_answer", fmt::format("more than {} keys", kMostKeys));
    }
    return true;
  };
  try {
    Json json = Json::parse(line, count);
    if (!json.is_object()) throw DetectorFailure("bad_answer", "not a JSON object");
    return json;
  } catch (const Json::exception&) {
    constexpr size_t kMostShown = 80;
    throw DetectorFailure("bad_json", fmt::format("it wrote '{}' on standard output, which is not "
                                                  "JSON; notes go to standard error",
                                                  Printable(line, kMostShown)));
  }
}

std::string TextOr(const Json& json, const std::string& key, const std::string& otherwise) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

std::string Required(const Json& json, const std::string& key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) throw std::runtime_error("no text " + key);
  return found->get<std::string>();
}

Json OptionsJson(const std::map<std::string, ParameterValue>& options) {
  Json json = Json::object();
  for (const auto& [name, value] : options) {
    std::visit([&json, &key = name](const auto& v) { json[key] = v; }, value);
  }
  return json;
}

Hello ParseHello(const Json& json) {
  const std::string sensor = Required(json, "sensor");
  Hello hello{.protocol = json.value("protocol", 0),
              .sensor = sensor == "rgbd" ? SensorKind::kRgbd : SensorKind::kStereo,
              .options = {}};
  for (const auto& [name, value] : json.at("options").items()) {
    if (value.is_boolean()) hello.options[name] = value.get<bool>();
    if (value.is_number()) hello.options[name] = value.get<double>();
    if (value.is_string()) hello.options[name] = value.get<std::string>();
  }
  return hello;
}

DetectOrder ParseDetect(const Json& json) {
  DetectOrder order{.id = json.at("id").get<int64_t>(), .files = {}};
  order.files.calibration = Required(json, "calibration");
  if (json.contains("left")) {
    order.files.sensor = SensorKind::kStereo;
    order.files.left = Required(json, "left");
    order.files.right = Required(json, "right");
  } else {
    order.files.sensor = SensorKind::kRgbd;
    order.files.color = Required(json, "color");
    order.files.depth = Required(json, "depth");
  }
  return order;
}

}  // namespace

std::string ExternalCommand::Title() const {
  return fmt::format("{}", fmt::join(words, " "));
}

std::string HelloRequest(const ExternalCommand& command) {
  return Dump({{"request", "hello"},
               {"protocol", kDetectorProtocol},
               {"sensor", ToString(command.sensor)},
               {"options", OptionsJson(command.options)}});
}

std::string DetectRequest(int64_t id, const ObservationFiles& files) {
  Json json = {{"request", "detect"}, {"id", id}};
  if (files.sensor == SensorKind::kStereo) {
    json["left"] = files.left.string();
    json["right"] = files.right.string();
  } else {
    json["color"] = files.color.string();
    json["depth"] = files.depth.string();
  }
  json["calibration"] = files.calibration.string();
  return Dump(json);
}

void CheckHelloAnswer(std::string_view line) {
  const Json json = ParseObject(line);
  if (json.contains("error")) throw DetectorFailure("refused", TextOr(json, "error", "no reason"));
  if (json.contains("request")) throw DetectorFailure("bad_answer", "it repeats the request");
  const auto protocol = json.find("protocol");
  if (protocol == json.end() || *protocol != kDetectorProtocol) {
    throw DetectorFailure(
        "bad_answer",
        fmt::format("it speaks protocol {}, this program speaks {}",
                    protocol == json.end() ? "of no number" : protocol->dump(), kDetectorProtocol));
  }
}

TimedDetection ParseDetectAnswer(std::string_view line, int64_t id) {
  const Json json = ParseObject(line);
  if (!json.contains("id") || json["id"] != id) {
    throw DetectorFailure("wrong_id",
                          fmt::format("it answers observation {}, not {}",
                                      json.contains("id") ? json["id"].dump() : "none", id));
  }
  if (TextOr(json, "outcome", "") == "error") {
    throw DetectorFailure("exception", TextOr(json, "detail", "no reason given"));
  }
  try {
    return DetectionFromJson(json);
  } catch (const std::runtime_error& error) {
    throw DetectorFailure("bad_answer", error.what());
  }
}

std::variant<Hello, DetectOrder> ParseRequest(std::string_view line) {
  try {
    const Json json = Json::parse(line);
    const std::string request = Required(json, "request");
    if (request == "hello") return ParseHello(json);
    if (request == "detect") return ParseDetect(json);
    throw std::runtime_error("unknown request " + request);
  } catch (const Json::exception& error) {
    throw std::runtime_error(error.what());
  }
}

std::string HelloAnswer() {
  return Dump({{"protocol", kDetectorProtocol}});
}

std::string RefusalAnswer(const std::string& reason) {
  return Dump({{"error", reason}});
}

std::string DetectAnswer(int64_t id, const TimedDetection& detection) {
  Json json = {{"id", id}};
  json.update(ToJson(detection.detection, detection.stages));
  return Dump(json);
}

std::string ErrorAnswer(int64_t id, const std::string& detail) {
  return Dump({{"id", id}, {"outcome", "error"}, {"detail", detail}});
}

}  // namespace fenestra
