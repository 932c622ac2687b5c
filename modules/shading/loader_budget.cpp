#include "modules/shading/loader_budget.h"

#include <fmt/format.h>

#include <algorithm>

namespace rastertlm::shading {
namespace {

constexpr double kMicroseconds = 1e6;

// Stores and `up`s of one loader.
struct Work {
  double stores = 0;
  double ups = 0;
};

double seconds(const LoaderParameters& loader, LoaderKind kind, TableKind table, const Work& work) {
  LoaderParameters chosen = loader;
  chosen.kind = kind;
  return work.stores * step_seconds(chosen, table, false) + work.ups * step_seconds(chosen, table, true);
}

}  // namespace

double step_seconds(const LoaderParameters& loader, TableKind kind, bool is_up) {
  if (loader.kind == LoaderKind::sequencer) return loader.sequencer_clock_ns * 1e-9;
  switch (kind) {
    case TableKind::diffuse_dot:
    case TableKind::specular_dot:
      return loader.dot_cycles / (loader.dot_clock_mhz * 1e6);
    case TableKind::diffuse:
      return loader.diffuse_cycles / (loader.diffuse_clock_mhz * 1e6);
    default:
      return (is_up ? loader.specular_up_cycles : loader.specular_right_cycles) / (loader.specular_clock_mhz * 1e6);
  }
}

double job_seconds(const LoaderParameters& loader, const TableJob& job) {
  const double store = step_seconds(loader, job.table.kind, false);
  if (const auto* ramp = std::get_if<Ramp>(&job.arguments)) return store * static_cast<double>(ramp->entries);
  const auto& moves = std::get<ScaledPath>(job.arguments).moves;
  const auto rights = std::count(moves.begin(), moves.end(), Move::right);
  const auto ups = static_cast<std::int64_t>(moves.size()) - rights + loader.argument_cycles;
  return store * static_cast<double>(rights) + step_seconds(loader, job.table.kind, true) * static_cast<double>(ups);
}

std::vector<LoadBudget> load_budgets(const ShadingParameters& shading, const LoaderParameters& loader,
                                     std::int64_t materials) {
  const std::int64_t dot = 3 * (std::int64_t{1} << shading.dot_table_address_bits);
  const std::int64_t entries = std::int64_t{1} << shading.index_bits;
  const std::int64_t outputs = std::int64_t{1} << shading.level_bits;
  const std::int64_t moves = entries + outputs - 1;
  const std::int64_t nine_bits = std::int64_t{1} << 9;
  const auto work = [](std::int64_t stores, std::int64_t ups = 0) {
    return Work{static_cast<double>(stores), static_cast<double>(ups)};
  };
  const Work dot_work = work(dot);
  const Work diffuse_work = work(materials * entries);
  const Work diffuse9_work = work(materials * nine_bits);
  const Work specular_work = work(materials * entries, materials * (outputs - 1 + loader.argument_cycles));

  std::vector<LoadBudget> budgets;
  const auto words = [&](const std::string& name, double used, const std::string& source) {
    budgets.push_back({name, used, name == "path_rom.moves" ? "cycles" : "words", source});
  };
  const auto time = [&](const std::string& name, LoaderKind kind, TableKind table, const Work& amount,
                        const std::string& source) {
    budgets.push_back({name, kMicroseconds * seconds(loader, kind, table, amount), "us", source});
  };
  const std::string by_clock = fmt::format("x {} ns", loader.sequencer_clock_ns);
  words("dot_table.words", dot_work.stores,
        fmt::format("3 x 2^{}, one dot-product unit", shading.dot_table_address_bits));
  time("dot_table.load_sequencer", LoaderKind::sequencer, TableKind::diffuse_dot, dot_work,
       fmt::format("{} {}", dot, by_clock));
  time("dot_table.load_68000", LoaderKind::mc68000, TableKind::diffuse_dot, dot_work,
       fmt::format("{} x {} cycles / {} MHz", dot, loader.dot_cycles, loader.dot_clock_mhz));
  words("diffuse.words", diffuse_work.stores,
        fmt::format("{} materials x 2^{}, one colour", materials, shading.index_bits));
  time("diffuse.load_sequencer", LoaderKind::sequencer, TableKind::diffuse, diffuse_work,
       fmt::format("{} {}", materials * entries, by_clock));
  time("diffuse.load_68000", LoaderKind::mc68000, TableKind::diffuse, diffuse_work,
       fmt::format("{} x {} cycles / {} MHz", materials * entries, loader.diffuse_cycles, loader.diffuse_clock_mhz));
  time("diffuse9.load_sequencer", LoaderKind::sequencer, TableKind::diffuse, diffuse9_work,
       fmt::format("{} materials x 2^9 {}: what a 9-bit index would take", materials, by_clock));
  words("specular.words", specular_work.stores, fmt::format("{} materials x 2^{}", materials, shading.index_bits));
  time("specular.load_sequencer", LoaderKind::sequencer, TableKind::specular, specular_work,
       fmt::format("{} x ({} moves + {}) {}", materials, moves, loader.argument_cycles, by_clock));
  time("specular.load_68000", LoaderKind::mc68000, TableKind::specular, specular_work,
       fmt::format("{} x ({} x {} + {} x {}) cycles / {} MHz", materials, entries, loader.specular_right_cycles,
                   outputs - 1 + loader.argument_cycles, loader.specular_up_cycles, loader.specular_clock_mhz));
  words("path_rom.moves", static_cast<double>(moves),
        "inputs + outputs - 1, a material, without its change of arguments");
  return budgets;
}

}  // namespace rastertlm::shading
