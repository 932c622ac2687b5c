#include "modules/shading/loader_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/shading/shared_load.h"
#include "src/base/fixed_point.h"

namespace rastertlm::shading {
namespace {

constexpr double kMicroseconds = 1e6;

// Stores and `up`s of one loader: of the largest share.
struct Work {
  std::int64_t stores = 0;
  std::int64_t ups = 0;
};

double seconds(const LoaderParameters& loader, LoaderKind kind, TableKind table, const Work& work) {
  LoaderParameters chosen = loader;
  chosen.kind = kind;
  return static_cast<double>(work.stores) * step_seconds(chosen, table, false) +
         static_cast<double>(work.ups) * step_seconds(chosen, table, true);
}

std::int64_t share(std::int64_t work, std::int64_t units) { return (work + units - 1) / units; }

// Figures of a machine's tables, and the work of the largest share of each.
struct Sizes {
  Sizes(const ShadingParameters& shading, const LoaderParameters& loader)
      : dot(std::int64_t{1} << shading.dot_table_address_bits),
        entries(std::int64_t{1} << shading.index_bits),
        outputs(std::int64_t{1} << shading.level_bits),
        parameters(loader) {}

  Work dot_work() const { return {3 * share(dot, parameters.dot.units)}; }
  Work diffuse_work(std::int64_t materials, std::int64_t of_entries) const {
    return {share(materials, parameters.diffuse.units) * of_entries};
  }
  Work specular_work(std::int64_t materials) const {
    const std::int64_t most = share(materials, parameters.specular.units);
    return {most * entries, most * (outputs - 1 + parameters.argument_cycles)};
  }
  std::int64_t moves() const { return entries + outputs - 1; }

  std::int64_t dot;
  std::int64_t entries;
  std::int64_t outputs;
  const LoaderParameters& parameters;
};

// "" for one loader; else what each of them does.
std::string sharing(std::int64_t units) { return units == 1 ? "" : fmt::format(", the largest share of {}", units); }

const std::string kDotMoves = "shading.dot_table_address_bits";
const std::string kLevelMoves = "shading.materials, shading.index_bits";
const std::string kPathMoves = "shading.materials, shading.index_bits, shading.level_bits, loader.argument_cycles";
const std::string kPathProgramMoves = "loader.specular.preset, loader.specular.clock_mhz";
const std::string kSequencerMoves = "loader.sequencer_clock_ns";

std::string ramp_moves(const std::string& table) {
  return fmt::format("loader.{0}.preset, loader.{0}.clock_mhz, loader.{0}.unroll", table);
}

class Budgets {
 public:
  Budgets(const ShadingParameters& shading, const LoaderParameters& loader, std::int64_t materials)
      : shading_(shading), loader_(loader), materials_(materials), sizes_(shading, loader) {}

  std::vector<LoadBudget> list() {
    add_dot();
    add_diffuse();
    add_specular();
    add("path_rom.moves", static_cast<double>(sizes_.moves()), "cycles",
        fmt::format("{} inputs + {} outputs - 1, a material, without its change of arguments", sizes_.entries,
                    sizes_.outputs),
        "shading.index_bits, shading.level_bits");
    return std::move(budgets_);
  }

 private:
  void add(const std::string& name, double used, const std::string& unit, const std::string& source,
           const std::string& moved_by) {
    budgets_.push_back({name, used, unit, source, moved_by});
  }
  void time(const std::string& name, LoaderKind kind, TableKind table, const Work& work, const std::string& source,
            const std::string& moved_by) {
    add(name, kMicroseconds * seconds(loader_, kind, table, work), "us", source, moved_by);
  }
  std::string units_key(const char* table) const { return fmt::format(", loader.{}.units", table); }

  void add_dot() {
    const Work work = sizes_.dot_work();
    const std::string moves = kDotMoves + units_key("dot") + ", ";
    const std::string shared = sharing(loader_.dot.units);
    add("dot_table.words", 3.0 * static_cast<double>(sizes_.dot), "words",
        fmt::format("3 x 2^{}, one dot-product unit", shading_.dot_table_address_bits), kDotMoves);
    time("dot_table.load_sequencer", LoaderKind::sequencer, TableKind::diffuse_dot, work,
         fmt::format("{} x {} ns{}", work.stores, loader_.sequencer_clock_ns, shared), moves + kSequencerMoves);
    time("dot_table.load_68000", LoaderKind::mc68000, TableKind::diffuse_dot, work,
         fmt::format("{} x {} / {} MHz{}", work.stores, loader_.dot.text(), loader_.dot.clock_mhz, shared),
         moves + ramp_moves("dot"));
  }

  void add_diffuse() {
    const Work work = sizes_.diffuse_work(materials_, sizes_.entries);
    const std::string moves = kLevelMoves + units_key("diffuse") + ", ";
    const std::string shared = sharing(loader_.diffuse.units);
    add("diffuse.words", static_cast<double>(materials_ * sizes_.entries), "words",
        fmt::format("{} materials x 2^{}, one colour", materials_, shading_.index_bits), kLevelMoves);
    time("diffuse.load_sequencer", LoaderKind::sequencer, TableKind::diffuse, work,
         fmt::format("{} x {} ns{}", work.stores, loader_.sequencer_clock_ns, shared), moves + kSequencerMoves);
    time("diffuse.load_68000", LoaderKind::mc68000, TableKind::diffuse, work,
         fmt::format("{} x {} / {} MHz{}", work.stores, loader_.diffuse.text(), loader_.diffuse.clock_mhz, shared),
         moves + ramp_moves("diffuse"));
    const Work nine_bits = sizes_.diffuse_work(materials_, std::int64_t{1} << 9);
    time("diffuse9.load_sequencer", LoaderKind::sequencer, TableKind::diffuse, nine_bits,
         fmt::format("{} x {} ns{}: what a 9-bit index would take", nine_bits.stores, loader_.sequencer_clock_ns,
                     shared),
         "shading.materials" + units_key("diffuse") + ", " + kSequencerMoves);
  }

  void add_specular() {
    const Work work = sizes_.specular_work(materials_);
    const std::int64_t most = share(materials_, loader_.specular.units);
    const std::string moves = kPathMoves + units_key("specular") + ", ";
    const std::string shared = sharing(loader_.specular.units);
    add("specular.words", static_cast<double>(materials_ * sizes_.entries), "words",
        fmt::format("{} materials x 2^{}", materials_, shading_.index_bits), kLevelMoves);
    time("specular.load_sequencer", LoaderKind::sequencer, TableKind::specular, work,
         fmt::format("{} x ({} moves + {}) x {} ns{}", most, sizes_.moves(), loader_.argument_cycles,
                     loader_.sequencer_clock_ns, shared),
         moves + kSequencerMoves);
    const PathProgram& program = loader_.specular;
    time("specular.load_68000", LoaderKind::mc68000, TableKind::specular, work,
         fmt::format("{} x ({} x {} + {} x {}) cycles{} / {} MHz{}", most, sizes_.entries, program.right_cycles,
                     sizes_.outputs - 1 + loader_.argument_cycles, program.up_cycles,
                     program.preset.empty() ? "" : fmt::format(" ({})", program.preset), program.clock_mhz, shared),
         moves + kPathProgramMoves);
  }

  const ShadingParameters& shading_;
  const LoaderParameters& loader_;
  std::int64_t materials_;
  Sizes sizes_;
  std::vector<LoadBudget> budgets_;
};

}  // namespace

double step_seconds(const LoaderParameters& loader, TableKind kind, bool is_up) {
  if (loader.kind == LoaderKind::sequencer) return loader.sequencer_clock_ns * 1e-9;
  switch (kind) {
    case TableKind::diffuse_dot:
    case TableKind::specular_dot:
      return loader.dot.cycles_an_entry() / (loader.dot.clock_mhz * 1e6);
    case TableKind::diffuse:
      return loader.diffuse.cycles_an_entry() / (loader.diffuse.clock_mhz * 1e6);
    default:
      return (is_up ? loader.specular.up_cycles : loader.specular.right_cycles) / (loader.specular.clock_mhz * 1e6);
  }
}

double job_seconds(const LoaderParameters& loader, const TableJob& job) {
  const std::uint64_t stores = stores_of(job);
  const std::uint64_t ups = steps_of(job, loader.argument_cycles) - stores;
  return static_cast<double>(stores) * step_seconds(loader, job.table.kind, false) +
         static_cast<double>(ups) * step_seconds(loader, job.table.kind, true);
}

std::vector<LoadBudget> load_budgets(const ShadingParameters& shading, const LoaderParameters& loader,
                                     std::int64_t materials) {
  return Budgets(shading, loader, materials).list();
}

std::vector<LoadBudget> reload_budgets(const ShadingParameters& shading, const LoaderParameters& loader,
                                       std::int64_t materials) {
  const Sizes sizes(shading, loader);
  const bool wired = loader.kind == LoaderKind::sequencer;
  const std::string dot_steps = ", " + (wired ? kSequencerMoves : ramp_moves("dot"));
  const std::string level_steps = ", " + (wired ? kSequencerMoves : ramp_moves("diffuse") + ", " + kPathProgramMoves);
  const auto dot = seconds(loader, loader.kind, TableKind::diffuse_dot, sizes.dot_work());
  const auto levels = [&](std::int64_t count) {
    return std::max(seconds(loader, loader.kind, TableKind::diffuse, sizes.diffuse_work(count, sizes.entries)),
                    seconds(loader, loader.kind, TableKind::specular, sizes.specular_work(count)));
  };
  const auto us = [](double time) { return kMicroseconds * time; };
  return {
      {"reload.camera", us(dot), "us",
       "the camera moves or a light turns: all dot-product tables, N.L and N.H at once; levels stay",
       kDotMoves + ", loader.dot.units" + dot_steps},
      {"reload.material", us(levels(1)), "us",
       "one material changes: its entries of the diffuse and specular tables, all at once; dot products stay",
       "shading.index_bits, shading.level_bits, loader.argument_cycles" + level_steps},
      {"reload.light_colour", us(levels(materials)), "us",
       fmt::format("a light's intensity changes: the entries of {} materials in its diffuse and specular tables",
                   materials),
       kPathMoves + ", loader.diffuse.units, loader.specular.units" + level_steps},
  };
}

StoreTime shortest_store_time(const LoaderParameters& loader) {
  if (loader.kind == LoaderKind::sequencer)
    return {loader.sequencer_clock_ns, "the sequencer's clock period", kSequencerMoves};
  const auto of = [](TableKind kind, double cycles, double clock_mhz, const std::string& moved_by) {
    return StoreTime{1e3 * cycles / clock_mhz,
                     fmt::format("{} cycles / {} MHz of the {} from store to store", cycles, clock_mhz,
                                 kEngineNames[engine_of(kind)]),
                     moved_by};
  };
  const auto of_ramp = [&of](TableKind kind, const std::string& table, const RampLoop& loop) {
    return of(kind, loop.cycles_between_stores(), loop.clock_mhz,
              loop.cycles > 0.0 ? fmt::format("loader.{0}.cycles, loader.{0}.clock_mhz", table)
                                : fmt::format("{}, loader.{}.body_cycles", ramp_moves(table), table));
  };
  const auto sooner = [](const StoreTime& a, const StoreTime& b) { return a.ns < b.ns; };
  return std::min(
      {of_ramp(TableKind::diffuse_dot, "dot", loader.dot), of_ramp(TableKind::diffuse, "diffuse", loader.diffuse),
       of(TableKind::specular, loader.specular.right_cycles, loader.specular.clock_mhz,
          kPathProgramMoves + ", loader.specular.right_cycles")},
      sooner);
}

std::int64_t path_moves_in(double time, const ShadingParameters& shading, const LoaderParameters& loader,
                           std::int64_t materials) {
  const Sizes sizes(shading, loader);
  const double a_store = step_seconds(loader, TableKind::specular, false);
  const double an_up = step_seconds(loader, TableKind::specular, true);
  const double path = static_cast<double>(sizes.entries) * a_store + static_cast<double>(sizes.outputs - 1) * an_up;
  const double left = time / static_cast<double>(share(materials, loader.specular.units)) -
                      static_cast<double>(loader.argument_cycles) * an_up;
  // A move that ends with the time is in it, whatever the last bit of a quotient says.
  const double moves = left * static_cast<double>(sizes.moves()) / path + 1e-6;
  return std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(moves)));
}

std::vector<LoaderLogic> loader_logic(const ShadingParameters& shading, const LoaderParameters& loader) {
  const std::string unit = loader.kind == LoaderKind::sequencer ? "sequencers" : "MC68000";
  std::vector<LoaderLogic> logic;
  // Loaders that share a table write at the same time: it stands in as many memories, each with the multiplexer that
  // takes its address from the pixel or from its loader.
  const auto add = [&](const std::string& name, std::int64_t tables, std::int64_t tables_a_loader, std::int64_t units,
                       std::int64_t address_bits) {
    logic.push_back({name + " loaders", static_cast<std::uint64_t>(tables / tables_a_loader * units), unit});
    logic.push_back({name + " table address multiplexers", static_cast<std::uint64_t>(tables * units),
                     fmt::format("of {} bits", address_bits)});
  };
  const auto material_bits = static_cast<std::int64_t>(bit_length(static_cast<std::uint64_t>(shading.materials - 1)));
  add("dot product", 6 * shading.lights, 3, loader.dot.units, shading.dot_table_address_bits);
  add("diffuse", 3 * shading.lights, 1, loader.diffuse.units, material_bits + shading.index_bits);
  add("specular", shading.specular_tables * shading.lights, 1, loader.specular.units,
      material_bits + shading.index_bits);
  return logic;
}

}  // namespace rastertlm::shading
