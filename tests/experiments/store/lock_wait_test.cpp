#include "experiments/store/lock_wait.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "core/io/system_error.h"
#include "experiments/store/store.h"
#include "tests/experiments/trial/record_examples.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::RandomHit;
using testing::TemporaryFolder;

/// Another program that keeps a place in a table, as a viewer does.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) {
    std::array<int, 2> ready{}, end{};
    EXPECT_EQ(pipe(ready.data()) + pipe(end.data()), 0);
    process_ = fork();
    if (process_ == 0) {
      sqlite3* database = nullptr;
      sqlite3_open(file.c_str(), &database);
      sqlite3_exec(database, "BEGIN; SELECT * FROM trials", nullptr, nullptr, nullptr);
      close(end[1]);
      char byte = 'r';
      if (write(ready[1], &byte, 1) == 1) [[maybe_unused]]
        const auto n = read(end[0], &byte, 1);
      _exit(0);
    }
    close(end[0]);
    end_ = end[1];
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1);
    close(ready[0]);
    close(ready[1]);
  }
  ~Reader() { Close(); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  pid_t process() const { return process_; }
  void Close() {
    if (end_ < 0) return;
    close(end_);
    end_ = -1;
    waitpid(process_, nullptr, 0);
  }

 private:
  pid_t process_;
  int end_;
};

class LockWaitTest : public ::testing::Test {
 protected:
  void TearDown() override { SetLockPatience({}); }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "results.sqlite";
  std::vector<TrialRecord> rows_ = {RandomHit(0, 0, "a")};
};

TEST_F(LockWaitTest, AReaderIsNamedAndWaitedFor) {
  ResultStore store = ResultStore::Create(file_, {});
  Reader reader(file_);
  std::vector<std::string> notices;
  SetLockPatience(
      {.notice_after = std::chrono::milliseconds(100), .notice = [&](const std::string& notice) {
         notices.push_back(notice);
         reader.Close();
       }});
  store.AddTrial(rows_);
  EXPECT_EQ(store.Rows().size(), 1u);
  EXPECT_THAT(notices,
              ElementsAre(AllOf(HasSubstr(file_.string()),
                                HasSubstr(fmt::format("(process {})", reader.process())))));
}

TEST_F(LockWaitTest, PatienceEndsAsAFailureOfTheMachineWithNothingStored) {
  ResultStore store = ResultStore::Create(file_, {});
  const Reader reader(file_);
  SetLockPatience({.longest = std::chrono::milliseconds(200)});
  try {
    store.AddTrial(rows_);
    FAIL() << "it must give up";
  } catch (const SystemError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("is locked by"),
                                    HasSubstr(fmt::format("(process {})", reader.process()))));
  }
  EXPECT_TRUE(store.Rows().empty());
}

TEST_F(LockWaitTest, NobodyIsNamedWhereNobodyIs) {
  ResultStore::Create(file_, {});
  EXPECT_EQ(LockHolders(file_), "another program");
  EXPECT_EQ(LockHolders(folder_ / "none"), "another program");
}

}  // namespace
}  // namespace fenestra
