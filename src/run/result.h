// What one simulation gives. Every figure has a unit in its name or beside it, and says where it comes from.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/frame/frame.h"
#include "src/reference/error_figures.h"
#include "src/run/timeline.h"

namespace rastertlm::run {

struct Bottleneck {
  std::string unit;
  std::string resource;
  double utilisation = 0.0;  // of what it may use in a frame
};

struct Answer {
  double frame_rate_hz = 0.0;     // the update rate, for the object machine
  double display_rate_hz = 0.0;   // frames scanned out each second
  double update_rate_hz = 0.0;    // display rate / frames that the slowest host needs for its coefficients
  double required_rate_hz = 0.0;  // video.refresh_hz
  bool sustained = false;
  double headroom = 0.0;  // rate that the bottleneck allows / required rate - 1
  Bottleneck bottleneck;
  std::uint64_t latency_frames = 0;     // from the start of an animation frame to its picture's first line
  double latency_first_pixel_us = 0.0;  // from the same to its first pixel, and to its last
  double latency_last_pixel_us = 0.0;
  std::uint64_t initial_load_frames = 0;  // video frames before the first picture
  double initial_load_us = 0.0;           // until the last unit has finished the first frame
  std::uint64_t initial_load_bytes = 0;   // of meshes and solids, that stay in the units' memories
  std::uint64_t torn_frames = 0;          // displayed frames with parts of two, words or light or lines of a screen
  bool display_works = true;              // every unit behind the host keeps its deadlines
  std::vector<std::string> limits;        // one sentence for everything that keeps the machine from its rate
};

struct UnitFigures {
  std::string name;
  double clock_hz = 0.0;
  std::uint64_t cycles = 0;  // over the displayed frames, in the unit's own clock
  std::uint64_t busy = 0;
  std::uint64_t starved = 0;
  std::uint64_t blocked = 0;
  std::uint64_t idle = 0;
  std::string clock{};  // its name
};

struct Budget {
  std::string name;
  double used = 0.0;
  double available = 0.0;
  std::string unit;  // "cycles", "us", "flop", "bytes", "words", "processors", "ns"
  bool fits = false;
  bool applies = true;   // this machine depends on it; false: stated for comparison
  std::string source;    // formula or paper
  std::string moved_by;  // the parameters that change it
};

struct LinkFigures {
  std::string name;
  unsigned bits = 0;
  double clock_hz = 0.0;
  std::uint64_t bytes = 0;
  double peak_bytes_per_s = 0.0;
  double achieved_bytes_per_s = 0.0;  // over the displayed frames
  double active_bytes_per_s = 0.0;    // while it was transferring
  double utilisation = 0.0;           // achieved / peak
};

struct Memory {
  std::string name;
  std::uint64_t instances = 0;
  std::uint64_t words = 0;
  std::uint64_t bits_per_word = 0;
  std::uint64_t total_bits() const { return instances * words * bits_per_word; }
};

struct Logic {
  std::string name;
  std::uint64_t count = 0;
  std::string unit;  // "adders", "comparators", "pins", "registers (bits)", ...
};

struct Modelled {
  std::uint64_t processors_available = 0;
  std::uint64_t processors_used = 0;          // hold an object
  std::uint64_t processors_instantiated = 0;  // simulated
  std::uint64_t lines_total = 0;              // scan lines x boards
  std::uint64_t lines_evaluated = 0;          // on which a board had something to do
  std::uint64_t coefficients_total = 0;       // of every slot that holds an object, an update: 22 of a triangle
  std::uint64_t coefficients_sent = 0;
  std::uint64_t objects_made = 0;        // triangles of the scene
  std::uint64_t objects_degenerate = 0;  // of zero area as made
  std::uint64_t objects_dropped = 0;     // found no processor
  std::uint64_t fragments_in = 0;
  std::uint64_t fragments_kept = 0;
  std::uint64_t fragments_hidden = 0;
  std::vector<std::string> left_out;  // sentences: what was not simulated because the scene does not need it
  std::uint64_t exact_wanted = 0;     // exact pictures, of each reference and field
  std::uint64_t exact_made = 0;       // of them, those whose view was not that of the picture before
  // Of quadric processors, as of triangle processors; solids are the objects that they show.
  std::uint64_t quadrics_available = 0;
  std::uint64_t quadrics_used = 0;
  std::uint64_t quadrics_instantiated = 0;
  std::uint64_t solids_made = 0;
  std::uint64_t solids_dropped = 0;
};

// What is left of the display's deadlines, where it is least.
struct Deadlines {
  struct Retrace {
    std::uint64_t available_cycles = 0;  // pixel clocks of the vertical retrace
    std::uint64_t boards_cycles = 0;     // of which pipeline skew and frame start take
    std::uint64_t tables_cycles = 0;     // and beside them the longest table load
    std::uint64_t frame = 0;             // displayed frame
    std::int64_t slack_cycles = 0;
    double slack_us = 0.0;
    std::string needs;  // "frame start" or "table load": what is left the least for
  } retrace;
  struct Lines {
    std::uint64_t available_cycles = 0;  // pixel clocks of horizontal blanking
    struct Worst {
      std::uint64_t frame = 0;
      std::uint64_t line = 0;
      std::uint64_t available_cycles = 0;  // until its first pixel: blanking; of the first of a retrace, that too
      std::uint64_t needed_cycles = 0;
      std::int64_t slack_cycles = 0;  // negative: late
      double slack_us = 0.0;
      std::string needs;  // "line start" or "table load"
    } worst;
    std::vector<std::int64_t> slack_cycles;  // a line of the picture, the least over the frames
  } lines;
  struct Host {
    bool shown = false;              // of an update that came in after the first picture; false: of the next one
    std::uint64_t frame = 0;         // displayed frame that showed it first
    std::uint64_t video_frames = 0;  // that the update took
    std::uint64_t used_cycles = 0;   // of the slowest unit, from retrace to last word, in host cycles
    std::int64_t slack_cycles = 0;   // host cycles to the end of one video frame; negative: late
    double slack_us = 0.0;
  } host;
};

// What only a machine with a span unit has.
struct SpanFrameFigures {
  std::uint64_t drawn_pieces = 0;  // triangles handed to the span unit, children of split ones counted one by one
  std::uint64_t splits = 0;
  std::uint64_t at_depth_limit = 0;        // not split any more, although the highlight test says so
  std::uint64_t flat = 0;                  // drawn in one colour: too low, or the solver had no answer
  std::uint64_t lighting_evaluations = 0;  // at points of triangles
  std::uint64_t shaded_pixels = 0;         // lit one by one, by a pixel unit
  std::uint64_t shading_flops = 0;         // that it took for them
  std::uint64_t step_edges = 0;            // that one triangle has whole and its neighbours, split, in parts
  double largest_step_levels = 0.0;        // of colour, along them
  std::uint64_t clamped_knots = 0;
  std::uint64_t not_finite = 0;
  std::uint64_t span_pixels = 0;        // drawn on the screen
  std::uint64_t off_screen_pixels = 0;  // stepped over
  double set_up_us = 0.0;               // from the frame's start to its last word, waits included
  double shown_us = 0.0;                // from the frame's start to the retrace that shows it
  std::uint64_t torn_lines = 0;         // of its screen, that do not show it as it was when it was whole
};

// Of a machine that looks for highlights before it draws (003).
struct HighlightFigures {
  std::uint64_t tested = 0;       // triangles
  std::uint64_t potentially = 0;  // that may hold the centre of a highlight
  std::uint64_t neighbours = 0;   // treated alike because they lie beside such
  std::uint64_t divided = 0;      // of all these, cut up
  std::uint64_t parts = 0;        // into
  std::uint64_t centres = 0;      // found inside, a light
  std::uint64_t beside = 0;       // found outside
  std::uint64_t unfound = 0;
  std::uint64_t at_limit = 0;  // not cut further, and larger or further off than the threshold, or not known to be less
  std::uint64_t at_grid_limit = 0;  // of them, because the grid of corners is not finer
  std::uint64_t stitched = 0;       // triangles that got corners from those beside them
  std::uint64_t stitch_corners = 0;
  // Against a search of every triangle, a light; where references are made.
  std::uint64_t true_centres = 0;
  std::optional<double> recall;     // share of them in triangles that may hold one; none: there is none
  std::optional<double> precision;  // share of such triangles that hold one
};

// One displayed frame: its figures, not its pixels. Of interlaced video two fields are one frame: figures of triangles
// are those of the first field's pose, operations and words those of both.
struct FrameFigures {
  std::uint64_t frame = 0;
  std::int64_t animation_frame = 0;       // the pose that it shows; of interlaced video, that of its even lines
  std::int64_t last_animation_frame = 0;  // that of its odd lines; the same where the video is not interlaced
  std::uint64_t first_pixel_ps = 0;       // since the first displayed frame's retrace began
  std::uint64_t last_pixel_ps = 0;
  std::uint64_t drawn = 0;   // triangles that have an area: facing + back_faces + outside
  std::uint64_t facing = 0;  // of them, those that face the viewer and are in view
  std::uint64_t back_faces = 0;
  std::uint64_t degenerate = 0;  // zero area, as made or after snapping
  std::uint64_t outside = 0;     // wholly outside the view volume
  std::uint64_t pieces = 0;      // more processors taken by clipping
  std::uint64_t pieces_dropped = 0;
  std::uint64_t solids_drawn = 0;
  std::uint64_t solids_outside = 0;  // nothing of them is in the view volume
  std::uint64_t solids_refused = 0;  // the machine's words cannot show them, and they are left out
  int snap_fraction_bits = 0;
  std::uint64_t covered_pixels = 0;
  std::uint64_t fragments = 0;
  std::uint64_t host_flops = 0;  // all computation units; 0 where nothing was computed for this frame
  std::uint64_t words_sent = 0;
  std::uint64_t words_ahead = 0;  // in use, of an update that the computation units have not finished
  bool light_apart = false;       // objects of one frame in the light of another
  bool torn() const { return words_ahead > 0 || light_apart || span.torn_lines > 0; }
  std::uint64_t late_table_lines = 0;     // shaded from half-written tables
  std::int64_t line_slack_cycles = 0;     // pixel clocks left at its worst line
  std::int64_t retrace_slack_cycles = 0;  // and of its retrace
  SpanFrameFigures span;                  // of a machine with a span unit
  HighlightFigures highlight;             // of an adaptive one
  std::optional<double> host_slack_us;  // between the last host's last word and its retrace; none: no new coefficients
  std::vector<reference::ErrorFigures> errors;  // empty without reference
};

// Pixels of a frame, on their way to whoever writes them.
struct FramePixels {
  const frame::Frame& shown;
  const frame::ExactFrame* ideal = nullptr;  // null without reference
  const FrameFigures& figures;
};
using FrameSink = std::function<void(const FramePixels&)>;

struct HostFigures {  // of the simulation itself; only reported when asked for
  double wall_seconds = 0.0;
  double simulated_clocks_per_second = 0.0;
  std::uint64_t peak_memory_bytes = 0;
  double exact_seconds = 0.0;    // that the exact pictures took, not in wall_seconds
  double figures_seconds = 0.0;  // and the figures of their differences
};

struct Result {
  std::string platform;
  std::string config_digest;
  std::string scene_digest;
  std::uint64_t frame_count = 0;
  // Frames that cycles, links and fragments are of: those that are displayed, and of a machine whose rate takes some
  // frames to show, others.
  std::uint64_t simulated_frames = 0;
  std::size_t columns = 0;
  std::size_t lines = 0;
  double obtained_refresh_hz = 0.0;
  bool interlaced = false;
  Answer answer;
  std::vector<UnitFigures> units;
  std::vector<Budget> budgets;
  Deadlines deadlines;
  std::vector<LinkFigures> links;
  std::vector<Memory> memories;
  std::vector<Logic> logic;
  Modelled modelled;
  std::vector<FrameFigures> frames;
  std::optional<double> flip_pixels_per_degree;  // where FLIP and CIEDE2000 were asked for
  std::vector<std::string> warnings;
  HostFigures host;
  std::shared_ptr<const Timeline> timeline;  // where it was asked for; in no report
};

}  // namespace rastertlm::run
