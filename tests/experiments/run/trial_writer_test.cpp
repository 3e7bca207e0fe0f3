#include "experiments/run/trial_writer.h"

#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/experiments/trial/record_examples.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using std::chrono::milliseconds;
using testing::RandomHit;
using testing::TemporaryFolder;

constexpr milliseconds kNever{1'000'000'000};

TEST(TrialWriterTest, WhatIsReportedIsInTheFile) {
  const TemporaryFolder folder;
  const auto file = folder / "results.sqlite";
  ResultStore store = ResultStore::Create(file, {});
  int reported = 0;
  const auto check = [&](std::span<const TrialRecord> rows) {
    ++reported;
    // Another connection sees only what is committed.
    EXPECT_EQ(ResultStore::OpenReadOnly(file).RowsOf({rows[0].cell, rows[0].trial}).size(), 2u);
  };
  TrialWriter writer(store, {.interval = milliseconds(1), .on_stored = check});
  {
    std::vector<std::jthread> threads;
    for (int cell = 0; cell < 3; ++cell) {
      threads.emplace_back([&writer, cell] {
        for (int trial = 0; trial < 20; ++trial) {
          writer.Add({RandomHit(cell, trial, "a"), RandomHit(cell, trial, "b")});
        }
      });
    }
  }
  writer.Finish();
  EXPECT_EQ(reported, 60);
  EXPECT_EQ(store.FinishedTrials().size(), 60u);
}

TEST(TrialWriterTest, QuickTrialsAreStoredInGroupsAndDoNotPileUp) {
  const TemporaryFolder folder;
  ResultStore store = ResultStore::Create(folder / "results.sqlite", {});
  TrialWriter writer(store, {.interval = kNever, .most_waiting = 10});
  // Twice as many as may wait: Add would block for ever if the writer slept on.
  for (int trial = 0; trial < 25; ++trial) writer.Add({RandomHit(0, trial)});
  writer.Finish();
  EXPECT_EQ(store.FinishedTrials().size(), 25u);
}

TEST(TrialWriterTest, NothingIsLostWhereARunEndsWithAnException) {
  const TemporaryFolder folder;
  ResultStore store = ResultStore::Create(folder / "results.sqlite", {});
  try {
    TrialWriter writer(store, {.interval = kNever});
    writer.Add({RandomHit(0, 0)});
    throw std::runtime_error("a trial failed");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(store.FinishedTrials().size(), 1u);
}

TEST(TrialWriterTest, AStoreThatRefusesIsNoticed) {
  const TemporaryFolder folder;
  ResultStore store = ResultStore::Create(folder / "results.sqlite", {});
  const std::vector<TrialRecord> row = {RandomHit(0, 0)};
  store.AddTrial(row);
  TrialWriter writer(store, {.interval = milliseconds(1)});
  writer.Add(row);  // It is there already.
  EXPECT_THROW(
      {
        for (int trial = 1; trial < 1000; ++trial) {
          writer.Add({RandomHit(0, trial)});
          std::this_thread::sleep_for(milliseconds(10));
        }
      },
      InputError);
  EXPECT_THROW(writer.Finish(), InputError);
}

}  // namespace
}  // namespace fenestra
