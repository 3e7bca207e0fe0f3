#include "vision/external/detector_server.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace fenestra {
namespace {

class Server {
 public:
  explicit Server(const ServedDetector& served) : served_(served) {}

  std::string Answer(const std::variant<Hello, DetectOrder>& request) {
    if (const Hello* hello = std::get_if<Hello>(&request)) return AnswerHello(*hello);
    const DetectOrder& order = std::get<DetectOrder>(request);
    if (!hello_) throw std::runtime_error("asked to detect before hello");
    try {
      return DetectAnswer(order.id, Detect(order.files));
    } catch (const std::exception& error) {
      return ErrorAnswer(order.id, error.what());
    } catch (...) {
      return ErrorAnswer(order.id, "of a type that is not std::exception");
    }
  }

 private:
  std::string AnswerHello(const Hello& hello) {
    if (hello.protocol != kDetectorProtocol) {
      return RefusalAnswer(fmt::format("this program speaks protocol {}, not {}", kDetectorProtocol,
                                       hello.protocol));
    }
    if (const std::string why = served_.objection(hello); !why.empty()) return RefusalAnswer(why);
    hello_ = hello;
    detector_.reset();
    return HelloAnswer();
  }

  TimedDetection Detect(const ObservationFiles& files) {
    const RecordedObservation recorded = ReadObservation(files);
    if (!detector_ || !(calibration_ == recorded.calibration)) {
      detector_ = served_.make(*hello_, recorded.calibration);
      calibration_ = recorded.calibration;
    }
    StageLog log(SteadyClock());
    Detection detection = detector_->Detect(recorded.observation, log);
    log.End();
    return {std::move(detection), log.times()};
  }

  const ServedDetector& served_;
  std::optional<Hello> hello_;
  std::optional<SensorCalibration> calibration_;
  std::unique_ptr<Detector> detector_;
};

}  // namespace

void ServeDetector(const ServedDetector& served, std::istream& in, std::ostream& out) {
  Server server(served);
  for (std::string line; std::getline(in, line);) {
    out << server.Answer(ParseRequest(line)) << std::endl;
  }
}

}  // namespace fenestra
