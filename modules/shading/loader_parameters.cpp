#include "modules/shading/loader_parameters.h"

#include <fmt/format.h>

namespace rastertlm::shading {
namespace {

using parameter::About;
using parameter::Condition;
using parameter::Table;

const std::string kTime = "load times of the shading tables";

Condition mc68000() { return {"loader.kind", {"mc68000"}}; }

void declare_preset(Table& table, const std::string& path, std::string& preset) {
  table.text(path + ".preset", preset,
             About{"", "Loop of the 68000 and its clock: sets the keys of its table that the file does not.", kTime,
                   mc68000()});
}

void declare_clock(Table& table, const std::string& path, double& mhz) {
  table.real(path + ".clock_mhz", mhz, {0.01, 100000.0}, About{"MHz", "Clock of the 68000.", kTime, mc68000()});
}

void declare_units(Table& table, const std::string& path, std::int64_t& units, const std::string& shared) {
  table.integer(
      path + ".units", units, {1, 65536},
      About{"loaders", "Loaders of one table's kind that share its " + shared + '.', kTime + ", logic of the loaders"});
}

void declare_ramp(Table& table, const std::string& path, RampLoop& loop) {
  declare_preset(table, path, loop.preset);
  declare_clock(table, path, loop.clock_mhz);
  const auto cycles = [&](const std::string& key, double& target, double least, const std::string& text) {
    table.real(path + key, target, {least, 100000.0}, About{"cycles", text, kTime, mc68000()});
  };
  cycles(".body_cycles", loop.body_cycles, 0.01, "Cycles of the 68000 an entry, without the end of the loop.");
  cycles(".loop_cycles", loop.loop_cycles, 0.0, "Cycles of the 68000 at the end of the loop (dbra, taken).");
  table.integer(path + ".unroll", loop.unroll, {0, 65536},
                About{"entries", "Entries a pass of the loop; 0 is straight-line code without one.", kTime, mc68000()});
  cycles(".cycles", loop.cycles, 0.0,
         "Cycles of the 68000 an entry, whatever its loop is; 0 takes body + loop / unroll.");
}

}  // namespace

double RampLoop::cycles_an_entry() const {
  if (cycles > 0.0) return cycles;
  return body_cycles + (unroll > 0 ? loop_cycles / static_cast<double>(unroll) : 0.0);
}

double RampLoop::cycles_between_stores() const {
  if (cycles > 0.0) return cycles;
  return body_cycles + (unroll == 1 ? loop_cycles : 0.0);
}

std::string RampLoop::text() const {
  if (cycles > 0.0) return fmt::format("{} cycles (as given)", cycles);
  const std::string name = preset.empty() ? "" : preset + ": ";
  return unroll > 0
             ? fmt::format("{:.6g} cycles ({}{} + {} / {})", cycles_an_entry(), name, body_cycles, loop_cycles, unroll)
             : fmt::format("{} cycles ({}straight line)", cycles_an_entry(), name);
}

void LoaderParameters::declare(Table& table) {
  table.choice("loader.kind", kind, {"mc68000", "sequencer"},
               About{"", "Microprocessors, or a wired sequencer that writes one entry a clock.", kTime});
  table.choice("loader.when", when, {"frame", "retrace"},
               About{"", "During the previous frame into a second bank, or during vertical retrace.",
                     "memory bits, and when new tables show"});
  table.choice("loader.on_overrun", on_overrun, {"refuse", "show"},
               About{"",
                     "A load that does not fit the retrace: refuse it, or shade the lines from half-written tables and "
                     "count them.",
                     "the picture, images[].late_table_lines", Condition{"loader.when", {"retrace"}}});
  table.choice("loader.materials", materials, {"used", "all"},
               About{"", "Load the tables of materials that the scene uses, or of all that the machine has.", kTime});
  table.integer("loader.argument_cycles", argument_cycles, {0, 1000},
                About{"steps", "Steps to change the arguments of the specular algorithm, a material.", kTime});
  table.real("loader.sequencer_clock_ns", sequencer_clock_ns, {0.1, 10000.0},
             About{"ns", "Clock period of the wired sequencer.", kTime, Condition{"loader.kind", {"sequencer"}}});
  declare_ramp(table, "loader.dot", dot);
  declare_units(table, "loader.dot", dot.units, "entries");
  declare_ramp(table, "loader.diffuse", diffuse);
  declare_units(table, "loader.diffuse", diffuse.units, "materials");
  declare_preset(table, "loader.specular", specular.preset);
  declare_clock(table, "loader.specular", specular.clock_mhz);
  const auto cycles = [&](const std::string& key, double& target, const std::string& text) {
    table.real("loader.specular." + key, target, {0.01, 100000.0}, About{"cycles", text, kTime, mc68000()});
  };
  cycles("right_cycles", specular.right_cycles, "Cycles of the 68000 a horizontal move, which stores.");
  cycles("up_cycles", specular.up_cycles, "Cycles of the 68000 a vertical move, and an argument step.");
  declare_units(table, "loader.specular", specular.units, "materials");
}

void LoaderParameters::check(const ShadingParameters& shading, const std::string& file,
                             Diagnostics& diagnostics) const {
  const auto most = [&](const char* table, std::int64_t units, std::int64_t shares, const char* what) {
    if (units > shares)
      diagnostics.add({file, 0, fmt::format("loader.{}.units", table),
                       fmt::format("{} loaders cannot share {} {}", units, shares, what)});
  };
  most("dot", dot.units, std::int64_t{1} << shading.dot_table_address_bits,
       "entries of a dot-product table (shading.dot_table_address_bits)");
  most("diffuse", diffuse.units, shading.materials, "materials (shading.materials)");
  most("specular", specular.units, shading.materials, "materials (shading.materials)");
}

}  // namespace rastertlm::shading
