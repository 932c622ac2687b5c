// The numbers of a machine with quadric processors, and what follows from them, each worked out from the numbers alone.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rastertlm::test {

inline constexpr std::uint64_t kFrame = 333'333;  // pixel clocks of 60 ns
inline constexpr std::uint64_t kRetrace = 10'000;

// The numbers that a test changes; by default those of the machine file.
struct QuadricNumbers {
  std::uint64_t units = 8, triangles = 128, quadrics = 64;
  std::uint64_t word = 48, plane = 40, slice = 12, caps = 6, factor = 24;
  std::uint64_t root_integer = 10, root_guard = 6, output = 1;
  std::uint64_t normal = 12;
  bool half_unit = true, scaled = true, delay = false, kept = true;
  std::uint64_t columns = 64, lines = 64, fields = 1;

  std::vector<std::string> set() const {
    const auto value = [](const char* key, std::uint64_t number) { return fmt::format("{}={}", key, number); };
    const std::string q = "quadric_processor.";
    std::vector<std::string> all{value("host.computation_units", units), value("host.processors_per_unit", triangles)};
    for (const auto& [key, number] : std::map<std::string, std::uint64_t>{{"per_unit", quadrics},
                                                                          {"word_bits", word},
                                                                          {"plane_bits", plane},
                                                                          {"slice_bits", slice},
                                                                          {"caps", caps},
                                                                          {"multiplier_bits", factor},
                                                                          {"root_integer_bits", root_integer},
                                                                          {"root_guard_bits", root_guard},
                                                                          {"output_cycles", output}})
      all.push_back(value((q + key).c_str(), number));
    all.push_back(q + "root_reading=" + (half_unit ? "half_unit" : "floor"));
    all.push_back(q + "scaling=" + (scaled ? "object" : "fixed"));
    all.push_back(q + "alignment=" + (delay ? "delay" : "early_start"));
    all.push_back(q + "on_refusal=drop");
    all.push_back(value("object_processor.normal_bits", normal));
    all.push_back(value("video.columns", columns));
    all.push_back(value("video.lines", lines));
    all.push_back(std::string("video.interlaced=") + (fields == 2 ? "true" : "false"));
    all.push_back(std::string("host.swap=") + (kept ? "global" : "unconditional"));
    return all;
  }

  std::uint64_t slices(std::uint64_t bits) const { return (bits + slice - 1) / slice; }
  std::uint64_t line() const { return (kFrame - kRetrace) / (lines / fields); }
  std::uint64_t root_bits() const { return root_integer + root_guard; }
  std::uint64_t read_bits() const { return root_bits() + (half_unit ? 1 : 0); }
  // Stage i subtracts from a remainder of i + 2 bits, a slice a clock.
  std::uint64_t root_clocks() const {
    std::uint64_t clocks = 0;
    for (std::uint64_t stage = 1; stage <= root_bits(); ++stage) clocks += slices(stage + 2);
    return clocks;
  }
  // Of a tree of the caps and a plane of the view, a clock a level, whose lower slices follow the highest.
  std::uint64_t cap_clocks() const {
    std::uint64_t levels = 0;
    while ((1ULL << levels) < caps + 1) ++levels;
    return levels == 0 ? 0 : levels + slices(plane) - 1;
  }
  // Comparisons are a clock behind the sums.
  std::uint64_t depth_clocks() const {
    return std::max(root_clocks() + (scaled ? 1 : 0) + 1, cap_clocks()) + slices(plane);
  }
  // A component of the normal: 24 bits above the fraction of a constant, of which each row of the root's bits leaves
  // one that is final.
  std::uint64_t normal_word() const { return factor - 8 + 24; }
  std::uint64_t joined() const { return normal_word() - read_bits(); }
  std::uint64_t normal_clocks() const { return root_clocks() + slices(read_bits()) + slices(joined()); }
  std::uint64_t latency() const { return std::max(depth_clocks(), normal_clocks()) + output; }
  std::uint64_t pipeline_bits() const;  // registers of all this
  std::uint64_t link() const { return 24 + 3 * normal + 4; }
  // Of an EP2, to a line `passed` lines on.
  std::uint64_t line_start(std::uint64_t passed) const {
    const std::uint64_t n = slices(word);
    return n + 5 + passed * (3 * n + 12);
  }
  // After a retrace the EP2 shows the line that it was loaded for, and line 1, of the second field, is one on; the EP1s
  // of depth step to it, which takes longer.
  std::uint64_t first_line_start(std::uint64_t line_number) const {
    return std::max(line_start(line_number), (line_number + 1) * (2 * slices(plane) + 5));
  }
};

// Every register holds a word's slice from the clock that makes it to the last that reads it, or for a clock what comes
// out of a carry. The sums' first clock is clock 1.
inline std::uint64_t QuadricNumbers::pipeline_bits() const {
  std::uint64_t bits = output * link();
  const auto held = [&bits](std::uint64_t width, std::uint64_t made, std::uint64_t last_read) {
    bits += width * (last_read - made);
  };
  // The root: what is left of the radicand, what is found, the remainder; in a stage of more clocks those of the stage
  // before, and the difference so far with its borrow.
  const auto state = [this](std::uint64_t stage) { return 2 * (root_bits() - stage) + stage + stage + 1; };
  for (std::uint64_t stage = 1; stage <= root_bits(); ++stage) {
    bits += state(stage);
    for (std::uint64_t low = slice; low < stage + 2; low += slice) bits += state(stage - 1) + low + 1;
  }
  const std::uint64_t n = slices(plane), choice = n + 2;
  for (std::uint64_t j = 0; j < n; ++j) {
    const std::uint64_t width = std::min(slice, plane - j * slice);
    held(width, scaled ? 0 : 1, 1 + j);  // the root in depth words
    held(width, 1, 1 + j);               // l
    held(2 * width, 1 + j, choice);      // l - s and l + s
    bits += 5;                           // borrows of the comparators
    if (j > 0) bits += 2;                // carries
    if (caps == 0) continue;
    held(caps * width, 1, n - j);    // caps, of which the highest slice is looked at first
    bits += 2 * caps * (width + 2);  // choices of two trees: the word, and which it is or none yet
    held(width, 1, choice + j - 1);  // the entry, which the last choice made j clocks before its lowest slice
    held(width, 1, 1 + 2 * j);       // the exit, until it is compared
  }
  const std::uint64_t found = root_clocks() + (scaled ? 1 : 0) + 1;
  if (cap_clocks() > found) held(read_bits(), found, cap_clocks());
  // The normal: sum and carry above what is final, and of that what is above the fraction.
  const std::uint64_t fraction = factor - 8;
  const auto above_fraction = [fraction](std::uint64_t final) { return final > fraction ? final - fraction : 0; };
  for (std::uint64_t done = 0; done < read_bits();) {
    done = std::min(done + slice, read_bits());
    bits += 3 * (2 * (normal_word() - done) + above_fraction(done)) + (read_bits() - done);
  }
  const std::uint64_t joins = slices(joined());
  for (std::uint64_t j = 0; j < joins; ++j) {
    const std::uint64_t width = std::min(slice, joined() - j * slice);
    held(3 * 2 * width, 1, 1 + j);
    held(3 * width, 1 + j, 1 + joins);
    bits += 3 * (above_fraction(read_bits()) + (j > 0 ? 1 : 0));
  }
  // Whichever is ready waits for the other.
  if (depth_clocks() >= normal_clocks())
    held(read_bits(), normal_clocks(), depth_clocks());
  else
    held(24, depth_clocks(), normal_clocks());
  return bits;
}

}  // namespace rastertlm::test
