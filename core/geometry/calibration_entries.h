#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/io/yaml_reader.h"

namespace fenestra {

/// What a calibration file states beside its numbers. Entries of no concern are ignored: the tools
/// that write such files add dates, names and rectifications. Refused is what would be read
/// wrongly; each of these notes faults in the reader.

/// An entry that stands twice; a lens model other than that of Brown and Conrady; a unit of length
/// other than the metre. Entries of nested mappings count, too.
void CheckStatements(YamlReader& reader);

/// Entries that look like another way to state depth_unit_m, misspelt or in another unit.
void CheckDepthUnitIsStatedAsKnown(YamlReader& reader);

/// Whether a calibration file of an RGB-D sensor has a depth_unit_m.
bool StatesDepthUnit(const std::filesystem::path& file);

/// Why a depth image cannot have this unit, from 1 µm to 5 cm; nullopt if it can.
std::optional<std::string> DepthUnitObjection(double depth_unit_m);

/// Formats of other programs, with the way from them to the one that is read.
void CheckFormat(YamlReader& reader);

}  // namespace fenestra
