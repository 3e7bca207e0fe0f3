// What the harness itself costs: a study whose sensor and detectors take no time, so that all that
// is left is sampling, threads, rows, the store and the tables.
//
//     bench_study [TRIALS [JOBS [FOLDER]]]

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "tests/experiments/run/mock_study.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

double Megabytes() {
  std::ifstream statm("/proc/self/statm");
  double all = 0.0;
  double resident = 0.0;
  statm >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

double ProcessorSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double Now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

void Run(int trials, int jobs, const std::filesystem::path& out) {
  const Study study = testing::MockStudy(trials / 3);  // It has three cells.
  StudyRun run = testing::MockRun(study, out);
  run.jobs = jobs;
  const int64_t total = CountTrials(study);
  int64_t done = 0;
  const double started_s = Now();
  const double processor_s = ProcessorSeconds();
  double run_s = 0.0;
  double run_processor_s = 0.0;
  fmt::print("{:>10} {:>10}\n", "trials", "memory MB");
  run.on_stored = [&](std::span<const TrialRecord>) {
    if (++done % std::max<int64_t>(total / 5, 1) == 0)
      fmt::print("{:>10} {:>10.1f}\n", done, Megabytes());
    if (done == total) {
      run_s = Now() - started_s;
      run_processor_s = ProcessorSeconds() - processor_s;
    }
  };
  RunStudy(run);
  const double all_s = Now() - started_s;
  fmt::print("{:>10} {:>10.1f}\n", "tables", Megabytes());
  const double n = static_cast<double>(total);
  fmt::print(
      "{} trials, 2 detectors, {} jobs: {:.1f} us a trial, {:.1f} us of processor time; tables and "
      "CSV after that: {:.1f} us a trial; store: {:.0f} bytes a trial\n",
      total, jobs, 1e6 * run_s / n, 1e6 * run_processor_s / n, 1e6 * (all_s - run_s) / n,
      static_cast<double>(std::filesystem::file_size(out / "results.sqlite")) / n);
}

}  // namespace
}  // namespace fenestra

int main(int argc, char** argv) {
  const fenestra::testing::TemporaryFolder folder;
  const int trials = argc > 1 ? std::atoi(argv[1]) : 100'000;
  const int jobs = argc > 2 ? std::atoi(argv[2]) : 1;
  fenestra::Run(trials, jobs, argc > 3 ? std::filesystem::path(argv[3]) : folder / "out");
}
