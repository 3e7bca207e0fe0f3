#include "scenes/facade/facade_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/io/input_error.h"
#include "scenes/facade/facade.h"
#include "scenes/facade/facade_parts.h"
#include "tests/scenes/facade/facade_examples.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;

// The faults of a sound facade after a change, line by line; "" for none.
std::string FaultsAfter(const std::function<void(FacadeOptions&)>& change,
                        FacadeOptions options = CoveredFacade()) {
  change(options);
  try {
    Validate(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FacadeCheck, TheExamplesAreSound) {
  EXPECT_EQ(FaultsAfter([](FacadeOptions&) {}), "");
  EXPECT_EQ(FaultsAfter([](FacadeOptions&) {}, StreetFacade()), "");
  EXPECT_EQ(FaultsAfter([](FacadeOptions&) {}, FacadeOptions()), "");
}

TEST(FacadeCheck, SizesArePositiveNumbers) {
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(FaultsAfter([&](auto& o) { o.wall.thickness_m = bad; }),
                HasSubstr("wall_thickness_m must be positive"));
    EXPECT_THAT(FaultsAfter([&](auto& o) { o.window.frame_depth_m = bad; }),
                HasSubstr("frame_depth_m must be positive"));
    EXPECT_THAT(FaultsAfter([&](auto& o) { o.room.depth_m = bad; }),
                HasSubstr("room_depth_m must be positive"));
  }
}

TEST(FacadeCheck, TheFrameFitsIntoItsOpeningAndItsWall) {
  EXPECT_THAT(FaultsAfter([](auto& o) { o.window.frame_width_m = 0.5; }),
              HasSubstr("two sides of a frame of 0.5 m do not fit into 1 m x 1 m"));
  // Set back by 10 cm and 6 cm deep in a wall of 30 cm.
  EXPECT_EQ(FaultsAfter([](auto& o) { o.wall.thickness_m = 0.161; }), "");
  EXPECT_THAT(FaultsAfter([](auto& o) { o.wall.thickness_m = 0.159; }),
              HasSubstr("does not fit into a wall of 0.159 m"));
  EXPECT_THAT(FaultsAfter([](auto& o) {
                o.window.double_glazing = true;
                o.window.frame_depth_m = 0.015;
              }),
              HasSubstr("two panes 0.016 m apart do not fit"));
}

TEST(FacadeCheck, MullionsFitIntoTheFrame) {
  // 0.8 m clear, bars of 4 cm.
  EXPECT_EQ(FaultsAfter([](auto& o) { o.window.vertical_mullions = 19; }), "");
  EXPECT_THAT(FaultsAfter([](auto& o) { o.window.vertical_mullions = 20; }),
              HasSubstr("vertical_mullions of 0.04 m each do not fit into 0.8 m: 20"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.window.horizontal_mullions = -1; }),
              HasSubstr("horizontal_mullions must be 0 or more, not -1"));
}

TEST(FacadeCheck, TheGridFitsOnTheWall) {
  // Three columns of 1 m with gaps of 1.3 m and 10 cm of masonry around: 5.8 m.
  EXPECT_EQ(FaultsAfter([](auto& o) { o.wall.width_m = 5.81; },
                        [] {
                          FacadeOptions o;
                          o.grid = {.windows_left = 1, .windows_right = 1, .gap_x_m = 1.3};
                          return o;
                        }()),
            "");
  EXPECT_THAT(FaultsAfter([](auto& o) { o.wall.width_m = 5.79; }),
              HasSubstr("need a wall of 5.8 m in width"));
  // The wall is centred on the target, so one column on one side needs as much as on both.
  EXPECT_THAT(FaultsAfter([](auto& o) {
                o.wall.width_m = 5.79;
                o.grid.windows_left = 0;
              }),
              HasSubstr("need a wall of 5.8 m in width"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.grid.gap_y_m = 0.1; }),
              HasSubstr("a ceiling lies between two rooms"));
}

TEST(FacadeCheck, PaintsReflectWhatTheirHueAllows) {
  EXPECT_THAT(FaultsAfter([](auto& o) { o.window.frame.reflectance = 1.2; }),
              HasSubstr("frame_reflectance must be in [0, 1], not 1.2"));
  EXPECT_THAT(FaultsAfter([](auto& o) {
                o.shutters.paint.hue = Hue::kGreen;
                o.shutters.paint.reflectance = 0.95;
              }),
              HasSubstr("shutter_reflectance can be up to"));
}

TEST(FacadeCheck, WhatStandsBesideAWindowHasRoomThere) {
  const double reach_m = ShutterReach_m(1.0);
  const auto with_gap = [&](double gap_m) {
    return FaultsAfter([&](FacadeOptions& o) {
      o.drainpipe.present = false;
      o.grid.gap_x_m = gap_m;
    });
  };
  EXPECT_EQ(with_gap(2.0 * reach_m + 0.01), "");
  EXPECT_THAT(with_gap(2.0 * reach_m - 0.01), HasSubstr("an open shutter needs"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.sill.overhang_m = 0.7; }), HasSubstr("the sill needs"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.lintel.height_m = 0.61; }),
              HasSubstr("the lintel needs 0.61 m of wall"));
  // What is not there needs no room.
  EXPECT_EQ(FaultsAfter([](auto& o) {
              o.sill.present = false;
              o.sill.overhang_m = 0.7;
            }),
            "");
}

TEST(FacadeCheck, ADrainpipeStandsBeforeNoWindow) {
  EXPECT_THAT(FaultsAfter([](auto& o) { o.drainpipe.x_m = 0.0; }),
              HasSubstr("would stand before the windows or the shutters of the column at x = 0 m"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.drainpipe.x_m = 2.3; }),
              HasSubstr("of the column at x = 2.3 m"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.drainpipe.x_m = 6.0; }),
              HasSubstr("does not stand before a wall of 12 m"));
}

TEST(FacadeCheck, WhatHangsBeforeTheWindowIsClearOfTheWall) {
  EXPECT_THAT(FaultsAfter([](auto& o) { o.cables.distance_m = 0.008; }),
              HasSubstr("cables 0.008 m before the wall"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.cables.count = -1; }),
              HasSubstr("cables must be 0 or more, not -1"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.railing.bar_spacing_m = 0.016; }),
              HasSubstr("railing_bar_spacing_m must be greater than a bar's thickness"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.railing.distance_m = 0.008; }),
              HasSubstr("railing_distance_m must be greater"));
}

TEST(FacadeCheck, CoversAreShares) {
  EXPECT_THAT(FaultsAfter([](auto& o) { o.blind.coverage = 1.01; }),
              HasSubstr("blind_coverage must be in [0, 1]"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.plant.coverage = 0.96; }),
              HasSubstr("plant_coverage must be in [0, 0.95]"));
  EXPECT_THAT(FaultsAfter([](auto& o) { o.blind.slat_tilt_rad = 1.6; }),
              HasSubstr("slat_tilt_rad must be in"));
}

TEST(FacadeCheck, AllFaultsOfSizesAreReportedAtOnce) {
  try {
    MakeFacade({.wall = {.width_m = 1.0},
                .window = {.frame_width_m = 0.5, .setback_m = 0.25},
                .room = {.paint = {.reflectance = -0.1}}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 4u) << error.what();
  }
}

TEST(FacadeCheck, AllFaultsOfPartsAreReportedAtOnce) {
  FacadeOptions o = CoveredFacade();
  o.grid.windows_left = -1;
  o.grid.other_windows_share = 1.5;
  o.room.lamp_lm = -3.0;
  o.sill.thickness_m = 0.0;
  o.drainpipe.x_m = 0.2;  // Before the target.
  o.cables.distance_m = 0.001;
  o.railing.bar_spacing_m = 0.0;
  o.blind.coverage = 1.2;
  o.plant.paint.reflectance = 0.9;  // More than a green can have.
  o.seed = std::numeric_limits<double>::quiet_NaN();
  try {
    Validate(o);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 10u) << error.what();
  }
}

TEST(FacadeCheck, ATextureReflectsNoMoreLightThanThereIs) {
  EXPECT_THAT(FaultsAfter([](auto& o) { o.wall.texture_contrast = 0.2; }),
              HasSubstr("would have to reflect"));
}

}  // namespace
}  // namespace fenestra
