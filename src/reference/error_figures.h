// How far a machine's picture is from an exact one, in figures.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace rastertlm::reference {

// A pixel is covered where `object` is not 0. Levels are compared where both pictures are covered ("compared" pixels),
// a channel at a time: the displayed level minus floor(exact + 1/2), an integer. Pixels that one picture alone covers
// are counted, not compared.
// The number types are those of one frame's figures (FrameFigures); means of many frames have others.
template <class Count, class Level, class Real, class MaybeReal>
struct PartFigures {
  Count compared{};               // pixels covered in both
  Count covered_missing{};        // pixels covered in the exact picture only
  Count covered_extra{};          // pixels covered in the machine's only
  Count wrong_object{};           // compared pixels that show different triangles
  Level max_level{};              // largest |difference| of all compared pixels
  Level max_level_same_object{};  // of those that show the same triangle
  Real rmse_level{};              // root of the mean square difference, over the channels of all compared pixels
  Real rmse_unrounded_level{};    // the same with the exact level not rounded: holds the display's own rounding, 0.29
                                  // levels at best; within 2.1e-7 of itself
  MaybeReal psnr_db{};            // 20 log10(255 / rmse_level); none where rmse_level is 0 (infinite)
  MaybeReal psnr_outline_db{};    // the same over the pixels that either picture covers: a missing pixel counts by what
                                  // is seen instead
  Real over_one_level_percent{};  // compared pixels with a channel that differs by more than one level
  Real over_two_levels_percent{};
  // Of wrong_object, those that show what lies in front of, or behind, everything that the exact picture shows around
  // them, by more than the margin of the depth words: no tie, and no edge that moved.
  Count wrong_order{};
  // Mach bands. At an edge between two triangles of a surface that goes on, the slope of the levels jumps: the
  // difference of the two pixels beyond the edge minus that of the two before it. The displayed jump minus the exact
  // one, of all channels. Measured in lines and columns where the picture has the four pixels' triangles right.
  Count edges_measured{};
  MaybeReal edge_jump_rms_level{};  // none where no edge is measured
  MaybeReal edge_jump_max_level{};  // |difference|
  // Flicker. Of pixels compared in this frame and in the one before, whose exact levels differ by one at most in every
  // channel: the change of the error, of all channels.
  Count still_pixels{};
  MaybeReal flicker_rms_level{};  // none where nothing stands still
  MaybeReal flicker_max_level{};  // |change|
  // As the eye sees it, of all pixels of the part (the whole picture: with its background): see picture_metrics.h. The
  // exact picture is rounded to levels, as a display would show it. None where it was not asked for.
  MaybeReal flip_mean{};
  MaybeReal flip_p95{};
  MaybeReal ciede2000_mean{};
  MaybeReal ciede2000_p99{};
};

using RegionFigures = PartFigures<std::uint64_t, int, double, std::optional<double>>;

// Of the whole picture, and of parts of it: frame::Region of the exact picture. Compared and missing pixels of the
// parts add up to those of the whole.
struct ErrorFigures : RegionFigures {
  std::string reference;  // "ideal", "snapped", "true", "sphere"
  RegionFigures inside;
  RegionFigures silhouettes;
  RegionFigures highlights;
};

// Calls f(part of each argument...) for the whole picture and for its parts.
template <class F, class... Figures>
void for_each_part(const F& f, Figures&... figures) {
  f(figures...);
  f(figures.inside...);
  f(figures.silhouettes...);
  f(figures.highlights...);
}

enum class Worse { larger, smaller };

// Calls f(figure of each argument..., which is worse) for every figure of a part.
template <class F, class... Parts>
void for_each_figure(const F& f, Parts&... p) {
  f(Worse::larger, p.compared...);
  f(Worse::larger, p.covered_missing...);
  f(Worse::larger, p.covered_extra...);
  f(Worse::larger, p.wrong_object...);
  f(Worse::larger, p.max_level...);
  f(Worse::larger, p.max_level_same_object...);
  f(Worse::larger, p.rmse_level...);
  f(Worse::larger, p.rmse_unrounded_level...);
  f(Worse::smaller, p.psnr_db...);
  f(Worse::smaller, p.psnr_outline_db...);
  f(Worse::larger, p.over_one_level_percent...);
  f(Worse::larger, p.over_two_levels_percent...);
  f(Worse::larger, p.wrong_order...);
  f(Worse::larger, p.edges_measured...);
  f(Worse::larger, p.edge_jump_rms_level...);
  f(Worse::larger, p.edge_jump_max_level...);
  f(Worse::larger, p.still_pixels...);
  f(Worse::larger, p.flicker_rms_level...);
  f(Worse::larger, p.flicker_max_level...);
  f(Worse::larger, p.flip_mean...);
  f(Worse::larger, p.flip_p95...);
  f(Worse::larger, p.ciede2000_mean...);
  f(Worse::larger, p.ciede2000_p99...);
}

}  // namespace rastertlm::reference
