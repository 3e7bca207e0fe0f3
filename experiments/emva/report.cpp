#include "experiments/emva/report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/output/text_table.h"

namespace fenestra::emva {
namespace {

struct Figure {
  std::string name;
  std::string unit;
  double measured;
  std::optional<double> put_in;
};

double Decibel(double ratio) {
  return 20.0 * std::log10(ratio);
}

std::vector<Figure> FiguresOf(const Results& r, const std::optional<PutIn>& put_in) {
  const auto known = [&](auto PutIn::*figure) -> std::optional<double> {
    return put_in ? std::optional<double>(put_in.value().*figure) : std::nullopt;
  };
  const auto percent = [](std::optional<double> fraction) {
    return fraction ? std::optional(100.0 * *fraction) : std::nullopt;
  };
  return {{"system gain K", "DN/e", r.gain_dn_per_e, known(&PutIn::gain_dn_per_e)},
          {"quantum efficiency", "%", 100.0 * r.quantum_efficiency,
           percent(known(&PutIn::quantum_efficiency))},
          {"temporal dark noise", "e", r.dark_noise_e, known(&PutIn::dark_noise_e)},
          {"dark current", "e/s", r.dark_current_e_s, known(&PutIn::dark_current_e_s)},
          {"saturation capacity", "e", r.saturation_e, known(&PutIn::saturation_e)},
          {"DSNU", "e", r.dsnu_e.total, known(&PutIn::dsnu_e)},
          {"DSNU of rows", "e", r.dsnu_e.row, {}},
          {"DSNU of columns", "e", r.dsnu_e.column, {}},
          {"DSNU of pixels", "e", r.dsnu_e.pixel, {}},
          {"PRNU", "%", 100.0 * r.prnu.total, percent(known(&PutIn::prnu))},
          {"PRNU of rows", "%", 100.0 * r.prnu.row, {}},
          {"PRNU of columns", "%", 100.0 * r.prnu.column, {}},
          {"PRNU of pixels", "%", 100.0 * r.prnu.pixel, {}},
          {"absolute sensitivity threshold", "photons", r.threshold_photons, {}},
          {"largest signal to noise", "dB", Decibel(r.largest_snr), {}},
          {"dynamic range", "dB", Decibel(r.dynamic_range), {}},
          {"linearity error, least", "%", 100.0 * r.linearity_error_min, {}},
          {"linearity error, most", "%", 100.0 * r.linearity_error_max, {}}};
}

TextTable TableOf(const Results& results, const std::optional<PutIn>& put_in) {
  TextTable table;
  table.AddColumn("EMVA 1288 release 4.0", TextTable::Align::kLeft);
  table.AddColumn("unit", TextTable::Align::kLeft);
  if (put_in) table.AddColumn("put in");
  table.AddColumn("measured");
  if (put_in) table.AddColumn("difference");
  for (const Figure& figure : FiguresOf(results, put_in)) {
    std::vector<std::string> row = {figure.name, figure.unit};
    if (put_in) row.push_back(figure.put_in ? fmt::format("{:.4g}", *figure.put_in) : "");
    row.push_back(fmt::format("{:.4g}", figure.measured));
    if (put_in) {
      const bool comparable = figure.put_in && *figure.put_in != 0.0;
      row.push_back(comparable
                        ? fmt::format("{:+.1f} %", 100.0 * (figure.measured / *figure.put_in - 1.0))
                        : "");
    }
    table.AddRow(std::move(row));
  }
  return table;
}

std::string NoteOf(const Results& results) {
  if (!results.dark_noise_is_floor) return {};
  return "\nThe dark variance is below 0.24 DN2: quantisation hides the dark noise, which may be "
         "less\nthan the figure above. More bits or more gain would tell.\n";
}

}  // namespace

std::string ReportText(const Results& results, const std::optional<PutIn>& put_in) {
  return TableOf(results, put_in).ToPlainText() + NoteOf(results);
}

std::string ReportMarkdown(const Results& results, const std::optional<PutIn>& put_in) {
  return fmt::format(
      "# EMVA 1288 figures\n\n{} exposures, K and R fitted over the first {}.\n\n{}{}\n"
      "![Photon transfer](photon_transfer.png)\n",
      results.points.size(), results.last_fit_point + 1, TableOf(results, put_in).ToMarkdown(),
      NoteOf(results));
}

std::string ReportJson(const Results& results, const std::optional<PutIn>& put_in) {
  nlohmann::ordered_json json;
  for (const Figure& figure : FiguresOf(results, put_in)) {
    nlohmann::ordered_json entry = {
        {"figure", figure.name}, {"unit", figure.unit}, {"measured", figure.measured}};
    if (figure.put_in) entry["put_in"] = *figure.put_in;
    json["figures"].push_back(entry);
  }
  for (const TransferPoint& p : results.points) {
    json["points"].push_back({{"exposure_s", p.exposure_s},
                              {"photons", p.photons},
                              {"mean_dn", p.mean},
                              {"variance_dn2", p.variance},
                              {"dark_mean_dn", p.dark_mean},
                              {"dark_variance_dn2", p.dark_variance}});
  }
  return json.dump(2) + "\n";
}

}  // namespace fenestra::emva
