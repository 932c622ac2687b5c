// A sweep: which points of the space of machines and scenes to simulate, and what of their reports counts.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "src/config/overrides.h"
#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

// What one value of an axis means.
struct Choice {
  std::string text;                    // as the reader knows it
  std::vector<config::Override> sets;  // parameters and their values
  std::string file;                    // of an axis of machines or scenes: the file
  std::string curve{};                 // of which it is a point; empty: the axis has none
};

// A range without steps, from which random designs draw.
struct Span {
  double from = 0.0;
  double to = 0.0;
  bool logarithmic = false;
  bool integer = false;
};

struct Vary {
  enum class What { parameter, machine, scene };
  What what = What::parameter;
  std::string path;  // of the parameter, or the name of a group of them; "machine", "scene"
  std::string unit;
  std::vector<Choice> choices;
  std::optional<Span> span;          // then a design makes the choices
  std::optional<std::size_t> start;  // the choice of the baseline
  int line = 0;                      // in the sweep's file; 0: of machines and scenes
  bool given = false;                // points are compared only where it is the same
};

enum class Comparison { less, at_most, equal, not_equal, at_least, greater };

struct Constraint {
  std::string text;  // as it was written
  std::string path;  // of a figure
  Comparison comparison = Comparison::equal;
  double value = 0.0;
  bool alone = false;  // written without a comparison: a truth
  int line = 0;        // in the sweep's file
};

// Whether a figure meets it; one that is missing does not.
bool meets(const Constraint& constraint, const std::optional<double>& figure);

enum class Mode { grid, one_at_a_time, random, latin_hypercube };

struct Sweep {
  std::string file;
  std::string name;
  std::string question;
  std::vector<std::string> machines;   // files
  std::vector<std::string> scenes;     // files
  std::vector<config::Override> sets;  // of every point
  std::set<std::string> asked;         // the parameters of them that --set gave
  Mode mode = Mode::grid;
  std::uint64_t points = 0;  // of random designs
  std::uint64_t seed = 1;
  std::uint64_t frames = 1;  // displayed frames of every point
  bool reference = true;
  bool thumbnails = true;
  std::vector<Vary> axes;
  // What a machine may lack, and the line in the sweep's file.
  struct Written {
    bool optional = false;
    int line = 0;
  };
  std::vector<Objective> objectives;
  std::vector<Written> written_objectives;  // an objective each
  std::vector<FurtherFigure> further;
  std::vector<Written> written_further;  // one each
  std::vector<Constraint> constraints;
  bool baseline = false;  // every axis has a start, and the point of all of them belongs to the sweep
};

// Reads and checks a sweep file with the machines and scenes that it names; `sets` are arguments of --set, for every
// point, and go before the file's own. Throws InputError with everything that is wrong in them.
Sweep read_sweep(const std::string& file, const std::vector<std::string>& sets = {});

}  // namespace rastertlm::explore
