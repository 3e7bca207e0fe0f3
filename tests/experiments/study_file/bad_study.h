#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "tests/experiments/study_file/study_text.h"

namespace fenestra {

/// What every study begins with.
inline const std::string kStudyHead = "name: test\nrepetitions: 2\n";

/// A kind of bad study, with the position and the hint that its author gets.
struct BadStudy {
  const char* what;
  std::string text;
  std::string fault;  ///< Line, column and the part of the message that helps.

  friend std::ostream& operator<<(std::ostream& out, const BadStudy& study) {
    return out << study.what;
  }
};

inline std::string WithFactor(const std::string& line) {
  return kStudyHead + "factors:\n  " + line + "\n";
}

inline std::string NameOf(const ::testing::TestParamInfo<BadStudy>& info) {
  std::string name = info.param.what;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// Each is refused with its one fault.
class BadStudies : public ::testing::TestWithParam<BadStudy> {
 protected:
  static void ExpectFault() {
    EXPECT_THAT(FaultsOf(GetParam().text),
                ::testing::ElementsAre(::testing::HasSubstr(GetParam().fault)))
        << GetParam().what;
  }
};

}  // namespace fenestra
