#include "src/analysis/vectors_page.h"

#include <fmt/format.h>

#include <cmath>

namespace rastertlm::analysis {
namespace {

using report::VectorsManifest;

std::string head(const VectorsManifest& v) {
  return fmt::format(
      R"(# Vectors of displayed frame {frame}{field}

Stimulus and expected response for an RTL of the object machine (I.M.O.G.E.N.E.: {boards} boards of {slots} triangle processors, {topology}),
{columns} x {lines} pixels. {objects} processors show an object (the slots of the others are parked); {listed} have files here. Everything is what the simulated machine held and gave, bit for bit;
two runs write the same bytes.

| file | what |
|---|---|
| `board<b>_processor<p>_ep<e>.hex` | loading RAM of elementary processor e: A, B, C', one word of {word_bits} bits a line |
| `board<b>_processor<p>_material.hex` | the processor's material word (8 bits, of which the link takes {material_bits}) |
| `parked_ep<e>.hex`, `parked_material.hex` | what a processor without an object holds |
| `index.csv` | every word: board, processor, slot, object, ep, address, index on the bus, meaning, hexadecimal, value, unit, file |
| `microprogram.csv` | what an elementary processor does, a row a cycle: frame start, line start, pixel; `clocks` has a bit a slice of the adder, the lowest slice at the right |
| `light<l>_*.hex`, `ambient.hex`, `background.hex`, `*_rom*.hex` | tables of the shading processor, one word a line; `tables.csv` says what each is |
| `decision.csv` | expected at the decision unit's output, a pixel a row in raster order |
| `rgb.csv` | expected levels at the display, a pixel a row in raster order |
| `manifest.json` | digests of machine, scene and files; widths, binary points, cycles |
| `config.resolved.toml`, `scene.resolved.toml` | what was simulated |

Processor p = b x {slots} + slot, from 0: its address on the bus, its place in the chain and its leaf in the tree. Elementary processors: 0, 1, 2 edges;
3 depth; 4, 5, 6 normal x, y, z. Word 21 on a processor's bus (ep 7 in `index.csv`) is the material register. `object` is the triangle's number in the
scene, from 1: an observer's mark that no wire carries.

)",
      fmt::arg("frame", v.frame),
      fmt::arg("field", v.machine.fields == 1 ? std::string()
                                              : fmt::format(", field {}: its lines {}, {}, ...", v.field, v.field,
                                                            v.field + v.machine.fields)),
      fmt::arg("boards", v.machine.boards), fmt::arg("slots", v.machine.processors_per_board),
      fmt::arg("topology", v.machine.topology), fmt::arg("columns", v.machine.columns),
      fmt::arg("lines", v.machine.lines), fmt::arg("objects", v.processors_with_object),
      fmt::arg("listed", v.processors_listed), fmt::arg("word_bits", v.machine.word_bits),
      fmt::arg("material_bits", v.machine.material_bits));
}

std::string loading(const VectorsManifest& v) {
  const std::string torn = v.words_ahead == 0 ? ""
                                              : fmt::format(
                                                    "\nThis picture is torn: {} of the words belong to an update that "
                                                    "the computation units had not finished when the RAMs were copied. "
                                                    "Where the old words\nand the new have different binary points, "
                                                    "`index.csv` values the new ones by that of the old.\n",
                                                    v.words_ahead);
  return fmt::format(
      R"(## Loading

```systemverilog
reg [{word_top}:0] loading [0:2];                     // A, B, C' of one elementary processor
reg [7:0] material [0:0];
initial begin                                    // BOARD, PROCESSOR, EP: parameters of the instance
  $readmemh($sformatf("board%0d_processor%0d_ep%0d.hex", BOARD, PROCESSOR, EP), loading);
  $readmemh($sformatf("board%0d_processor%0d_material.hex", BOARD, PROCESSOR), material);
end
```

{unlisted} loads `parked_ep<e>.hex` and `parked_material.hex`: its edges are -1 everywhere, so that it covers nothing. (What the host
left in a parked processor's other words may differ; no pixel does.) The words are those that the loading RAMs held when the frame's retrace began: start the
frame with its frame-start microprogram, which copies them to the backup RAMs, or put them there at once. C in the backup RAM then
changes from line to line.
{torn}
)",
      fmt::arg("word_top", v.machine.word_bits - 1), fmt::arg("torn", torn),
      fmt::arg("unlisted", v.processors_listed == v.processors_with_object
                               ? std::string("A processor without files")
                               : fmt::format("These are the files of processors {} to {} alone, of those among them "
                                             "that hold an object; the picture is "
                                             "that of all processors. A processor of that range without files",
                                             v.first_processor, v.last_processor)));
}

std::string pixels(const VectorsManifest& v) {
  const std::string edges =
      v.machine.edge_fraction_bits < 0
          ? std::string(
                "every edge has a power of two of its own as scale: `index.csv` gives its words as signed integers")
          : fmt::format(
                "an edge word counts units of 2^-{} square pixel: the distance from the edge times the edge's length, "
                "in pixels",
                v.machine.edge_fraction_bits);
  const std::string carry = v.machine.carry_clock == "clock1"
                                ? ""
                                : "\nThis machine has `ep1.carry_clock = \"clock2\"`, the paper's text, which loses "
                                  "carries between the slices: its words are not those of the "
                                  "formula.\n";
  return fmt::format(
      R"(## From words to `decision.csv`

On column x and line y, both from 0, an elementary processor shows **A x + B (y + 1) + C' modulo 2^{w}**. B is added before the first line is
shown, so the host loaded C' = C - B. Everything wraps; nothing saturates. `microprogram.csv` is how: a read latches a RAM's output until the next, `select`
connects the backup RAM's input, and the carry out of a slice of the adder waits in a flip-flop that is clocked with that slice. A lower slice is ahead of the
highest by a clock a slice: its values wait in as many synchronisation registers, from which the word is read.
{carry}
- Coverage: a pixel is inside where the sign bits (bit {top}) of the three edge words are 0. The top-left rule is in C'.
- Nearest: the smaller depth word wins, compared as unsigned. **Equal depth keeps the lower processor number.** Where nothing covers, depth is
  {background} (all ones) and object 0; no unit looks at the other columns of such a row, and a test bench must not compare them.
- Pre-normalisation of the winner's three normal words N: m = ~N where N is negative (its sign bit set), else N; K = max(0, bits of the largest m - {mag});
  the link word is the sign bit above the {mag} bits of m >> K. All three share K.
- The link carries depth ({w} bits), three normal words ({n} bits each) and the material ({mat} bits). All columns of `decision.csv` are decimal.

Values in `index.csv`: {edges}; depth counts units of 2^-{depth} (near is the word {near}, far the word {far}); a
component of the normal counts units of 2^-{normal}. A and B are signed slopes a column and a line; C' is signed, but unsigned for depth. (Unit `px`: of an edge vector; `px2`: of its product with a distance;
`units`: of depth, {side} of them over the words' range.)

)",
      fmt::arg("w", v.machine.word_bits), fmt::arg("top", v.machine.word_bits - 1), fmt::arg("carry", carry),
      fmt::arg("background", v.machine.background_depth), fmt::arg("mag", v.machine.normal_bits - 1),
      fmt::arg("n", v.machine.normal_bits), fmt::arg("mat", v.machine.material_bits), fmt::arg("edges", edges),
      fmt::arg("depth", v.machine.depth_fraction_bits), fmt::arg("near", v.machine.near_depth),
      fmt::arg("far", v.machine.far_depth), fmt::arg("normal", v.machine.normal_fraction_bits),
      fmt::arg("side", std::ldexp(1.0, static_cast<int>(v.machine.word_bits) -
                                           static_cast<int>(v.machine.depth_fraction_bits))));
}

std::string shading(const VectorsManifest& v) {
  const report::VectorsShading& s = v.shading;
  const bool centred = s.arithmetic == "centred";
  const std::uint64_t root_shift = 2 * v.machine.normal_bits - s.normaliser_address_bits;
  const std::uint64_t product_shift = s.normaliser_output_bits + v.machine.normal_bits - 2 - s.dot_table_address_bits;
  const std::string squares =
      centred ? "S = sum of m (m + 1)" : "S = sum of m m, with m + 1 in place of m where the sign bit is set";
  const std::string product =
      centred ? fmt::format("((2 m + 1) r) >> {}", product_shift + 1) : fmt::format("(m r) >> {}", product_shift);
  return fmt::format(
      R"(## From `decision.csv` to `rgb.csv`

`{arithmetic}` arithmetic. For a pixel with an object, m the magnitude of a normal word and its sign bit above it:

1. {squares}; r = `inverse_root_rom`[S >> {root_shift}]; n = min({product}, {limit}) for each component.
2. For each light and for both directions (L: `diffuse_dot`, H: `specular_dot`): a term is the table's entry at n, all its bits inverted (one's complement, as a
   signed number) where the normal's sign and the direction's (`signs`) differ. The sum of the three {halves}; below 0 it
   is 0, above {full} it is {full}; the index is the sum >> {index_shift}.
3. level = ambient[3 material + colour] + for each light diffuse[material x {entries} + L's index] + specular[material x {entries} + H's index], at
   most {full_level}. Where all three m are 0 the lights add nothing.
4. The display shows round(level x 255 / {full_level}). A pixel without an object shows `background.hex`.

`path_rom_exponent<E>.hex` is what the specular loaders read to fill the specular tables; the shading processor does not look at it.

)",
      fmt::arg("arithmetic", s.arithmetic), fmt::arg("squares", squares), fmt::arg("root_shift", root_shift),
      fmt::arg("product", product), fmt::arg("limit", (std::uint64_t{1} << s.dot_table_address_bits) - 1),
      fmt::arg("halves", centred ? "is doubled and 3 is added (three halves of a unit)" : "is taken as it is"),
      fmt::arg("full", (std::uint64_t{1} << (s.dot_table_output_bits + (centred ? 1 : 0))) - 1),
      fmt::arg("index_shift", s.dot_table_output_bits - s.index_bits + (centred ? 1 : 0)),
      fmt::arg("entries", std::uint64_t{1} << s.index_bits),
      fmt::arg("full_level", (std::uint64_t{1} << s.level_bits) - 1));
}

std::string cycles(const VectorsManifest& v) {
  const report::VectorsTiming& t = v.timing;
  const std::string skew = t.skew_cycles == 0
                               ? "All processors work in the same cycle."
                               : fmt::format(
                                     "The microinstruction travels with the pixel: processor p works p x {} cycles "
                                     "later than processor 0 in all of this.",
                                     t.skew_cycles / (v.machine.boards * v.machine.processors_per_board - 1));
  const std::uint64_t line0 = t.first_pixel_word_cycle - t.line_start_cycles;
  const std::string rows = v.machine.fields == 1
                               ? fmt::format("Pixel (x, y) comes y x {} + x cycles after the first.", t.line_cycles)
                               : fmt::format("Pixel (x, y) comes (y - {}) / {} x {} + x cycles after the first.",
                                             v.field, v.machine.fields, t.line_cycles);
  const std::string starts = v.machine.fields == 1
                                 ? fmt::format("that of line y begins in cycle {} + y x {}.", line0, t.line_cycles)
                                 : fmt::format(
                                       "it runs twice before every line, for B y + C goes on by two lines, and once "
                                       "before line 0; before the first line the last run begins "
                                       "in cycle {}.",
                                       line0);
  return fmt::format(
      R"(## Which cycle to compare

Cycle 0 is the first step of the frame-start microprogram (Select) in processor 0: the retrace begins there. All cycles are of the pixel clock ({clock:.9g} ns).

| | first pixel (0, {first_y}) | last pixel ({last_x}, {last_y}) |
|---|---|---|
| words of processor 0 | {word0} | {word1} |
| decision unit's output | {decision0} | {decision1} |
| RGB output | {rgb0} | {rgb1} |

{rows} The frame start takes {frame_start} cycles. The line start takes {line_start} cycles, and its last step is
the cycle before that of column 0: {starts} {skew} From a pixel's words to the decision unit's output there
are {prenormalisation} cycle(s) of pre-normalisation and {decision} of comparison; from there to the levels {shading}. A test bench whose sequencer does not wait for a video
line compares the same rows in the same order; only the cycles of lines differ.

An output "of a cycle" is what stands in the register during that cycle, before the clock edge that ends it.

## Once more

`rastertlm vectors config.resolved.toml scene.resolved.toml --frame {frame}{field} --out DIR` writes the same vectors again, of the same processors with
`--processors` as it was given; the notes of origin in `*.resolved.toml`, and so their digests in the manifest, then name these files. A run into this
directory replaces its files, so keep what is yours elsewhere.
)",
      fmt::arg("clock", t.pixel_clock_ns), fmt::arg("last_x", v.machine.columns - 1), fmt::arg("first_y", v.field),
      fmt::arg("last_y", v.machine.lines - v.machine.fields + v.field), fmt::arg("word0", t.first_pixel_word_cycle),
      fmt::arg("word1", t.last_pixel_word_cycle), fmt::arg("decision0", t.first_pixel_decision_cycle),
      fmt::arg("decision1", t.last_pixel_decision_cycle), fmt::arg("rgb0", t.first_pixel_rgb_cycle),
      fmt::arg("rgb1", t.last_pixel_rgb_cycle), fmt::arg("frame_start", t.frame_start_cycles),
      fmt::arg("line_start", t.line_start_cycles), fmt::arg("rows", rows), fmt::arg("starts", starts),
      fmt::arg("skew", skew), fmt::arg("prenormalisation", t.prenormalisation_cycles),
      fmt::arg("decision", t.decision_cycles), fmt::arg("shading", t.shading_cycles), fmt::arg("frame", v.frame),
      fmt::arg("field", v.machine.fields == 1 ? std::string() : fmt::format(" --field {}", v.field)));
}

}  // namespace

std::string vectors_page(const VectorsManifest& manifest) {
  return head(manifest) + loading(manifest) + pixels(manifest) + shading(manifest) + cycles(manifest);
}

}  // namespace rastertlm::analysis
