// A detector that is a program of its own and misbehaves on demand:
//
//     fake_detector HOW [WHEN]
//
// HOW: what it does wrong. WHEN: "always" (default), "third": in about every third observation, as
// its pixels say, a number n: in the n-th observation that it is handed, or n+: from that one on, a
// path: once, while there is no such file.
// Else it answers with a window whose numbers come from the observation's bytes.

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

namespace {

using Json = nlohmann::ordered_json;

// FNV-1a.
uint64_t HashOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  uint64_t hash = 14695981039346656037u;
  for (std::istreambuf_iterator<char> c(stream), end; c != end; ++c) {
    hash = (hash ^ static_cast<unsigned char>(*c)) * 1099511628211u;
  }
  return hash;
}

void Say(const std::string& line) {
  std::cout << line << std::endl;
}

[[noreturn]] void Hang() {
  while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
}

Json Window(int64_t id, uint64_t hash) {
  const double x = static_cast<double>(hash % 1000003) / 3e6;  // All digits of a double.
  return {{"id", id},
          {"outcome", "window"},
          {"centroid_m", {x, -0.0, 1.0 / 3.0 + 1.5}},
          {"corners_m",
           {{x - 0.5, -0.5, 2}, {x + 0.5, -0.5, 2}, {x + 0.5, 0.5, 2}, {x - 0.5, 0.5, 2}}}};
}

void Misbehave(const std::string& how, Json answer) {
  if (how == "crash") {
    std::cerr << "about to end\n";
    signal(SIGSEGV, SIG_DFL);  // Sanitizers handle it otherwise.
    kill(getpid(), SIGSEGV);
  }
  if (how == "exit") _exit(3);
  if (how == "hang") Hang();
  if (how == "deaf") {  // Hangs and does not heed the end of its input or a polite signal.
    signal(SIGTERM, SIG_IGN);
    Hang();
  }
  if (how == "flood") {
    while (true) std::cout << std::string(1 << 16, 'x');
  }
  if (how == "flood_errors") {
    while (true) std::cerr << std::string(1 << 16, 'x') << '\n';
  }
  if (how == "twice") std::cout << answer.dump() << '\n' << answer.dump() << std::endl;
  if (how == "bad_json") Say("{\"id\": 1, \"outcome\": ");
  if (how == "nan") Say("{\"id\": 1, \"outcome\": \"window\", \"centroid_m\": [NaN, 0, 1]}");
  if (how == "binary") Say(std::string("\xff\x00\xfe", 3));
  if (how == "wrong_id") answer["id"] = 77;
  if (how == "wrong_shape") answer["corners_m"].erase(3);
  if (how == "no_centroid") answer.erase("centroid_m");
  if (how == "behind") answer["centroid_m"][2] = -1.0;
  if (how == "error") answer = {{"id", answer["id"]}, {"outcome", "error"}, {"detail", "too dark"}};
  if (how == "miss") answer = {{"id", answer["id"]}, {"outcome", "miss"}, {"reason", "no_contour"}};
  if (how == "stages") answer["stage_seconds"] = {{"look", 0.25}, {"think", 0.5}};
  if (how == "environment") {
    std::ifstream environment("/proc/self/environ");
    answer["others"] = {answer};
    answer = {{"id", answer["id"]}, {"outcome", "miss"}, {"reason", "seen"}};
  }
  if (how != "twice" && how != "bad_json" && how != "nan" && how != "binary") Say(answer.dump());
}

bool Now(const std::string& when, int count, uint64_t hash) {
  if (when == "always") return true;
  if (when == "third") return hash % 3 == 0;
  if (when.front() == '/') {
    const bool first = !std::filesystem::exists(when);
    std::ofstream mark(when);
    return first;
  }
  return when.back() == '+' ? count >= std::stoi(when) : count == std::stoi(when);
}

void Hello(const std::string& how) {
  if (how == "slow_start") std::this_thread::sleep_for(std::chrono::milliseconds(700));
  if (how == "no_hello") Hang();
  if (how == "refuse") return Say(R"({"error": "size_m must be positive"})");
  if (how == "other_protocol") return Say(R"({"protocol": 2})");
  Say(R"({"protocol": 1})");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string how = argc > 1 ? argv[1] : "fine";
  const std::string when = argc > 2 ? argv[2] : "always";
  int count = 0;
  for (std::string line; std::getline(std::cin, line);) {
    const Json request = Json::parse(line);
    if (request["request"] == "hello") {
      Hello(how);
      continue;
    }
    const uint64_t hash = HashOf(request.contains("left") ? request["left"] : request["color"]);
    const Json answer = Window(request["id"], hash);
    if (Now(when, ++count, hash)) {
      if (how == "cleared") {  // By others, as a clean-up of temporary files would.
        std::filesystem::remove_all(
            std::filesystem::path(request["calibration"].get<std::string>()).parent_path());
        Say(Json({{"id", answer["id"]}, {"outcome", "error"}, {"detail", "no file"}}).dump());
        continue;
      }
      Misbehave(how, answer);
    } else {
      Say(answer.dump());
    }
  }
}
