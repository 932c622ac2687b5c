#include "modules/quadric_processor/quadric_pixel.h"

#include <algorithm>

namespace rastertlm::quadric_processor {

std::uint64_t root_of(std::uint64_t discriminant, const object_processor::RootFormat& format) {
  return object_processor::square_root(std::min(discriminant, format.largest_word()), format);
}

PixelWords pixel_words(const QuadricWords& words, std::uint32_t x, std::uint32_t y, const QuadricParameters& parameters,
                       unsigned normal_word_bits) {
  PixelWords pixel;
  pixel.discriminant =
      object_processor::second_order_value(words.discriminant, x, y, static_cast<unsigned>(parameters.word_bits));
  const auto plane_bits = static_cast<unsigned>(parameters.plane_bits);
  pixel.middle = plane_at(words.middle, x, y, plane_bits);
  for (std::size_t i = 0; i < kMostCaps; ++i) pixel.caps[i] = plane_at(words.caps[i].plane, x, y, plane_bits);
  for (std::size_t i = 0; i < 3; ++i) {
    const LinearWords& normal = words.normal[i];
    pixel.normal[i] =
        static_cast<std::uint32_t>((normal.a * x + normal.b * (y + 1) + normal.c) & low_mask(normal_word_bits));
  }
  return pixel;
}

// Entry and exit by the caps and the planes of the view.
struct QuadricPixelLogic::Ray {
  Entry entry;
  std::int64_t last = 0;
  bool beside = false;  // a plane along the rays leaves nothing here
};

QuadricPixelLogic::Ray QuadricPixelLogic::cut(const QuadricWords& words, const PixelWords& pixel) const {
  Ray ray{{range_.near}, range_.far};
  for (std::size_t i = 0; i < static_cast<std::size_t>(parameters_.caps); ++i) {
    const std::int64_t at = pixel.caps[i];
    const CapKeeps keeps = words.caps[i].keeps;
    if (keeps == CapKeeps::side && at < 0) ray.beside = true;
    if (keeps == CapKeeps::before) ray.last = std::min(ray.last, at);
    if (keeps == CapKeeps::beyond && at > ray.entry.depth) ray.entry = {at, Surface::cap, static_cast<std::uint8_t>(i)};
  }
  return ray;
}

QuadricPixel QuadricPixelLogic::operator()(const QuadricWords& words, const PixelWords& pixel) const {
  const auto plane_bits = static_cast<unsigned>(parameters_.plane_bits);
  auto [entry, last, beside] = cut(words, pixel);
  const bool outside_roots = (pixel.discriminant >> (parameters_.word_bits - 1)) != 0;
  const std::uint64_t root = outside_roots ? 0 : root_of(pixel.discriminant, root_);
  const std::int64_t half = shifted_root(root, words.root_shift);
  const auto wrapped = [plane_bits](std::int64_t depth) {
    return sign_extended(static_cast<std::uint64_t>(depth), plane_bits);
  };
  const std::int64_t near_root = wrapped(pixel.middle - half);
  const std::int64_t far_root = wrapped(pixel.middle + half);
  bool inside = false;
  switch (words.part) {
    case RayPart::between:
      if (near_root > entry.depth) entry = {near_root, Surface::near_root};
      inside = !outside_roots && entry.depth <= std::min(last, far_root);
      break;
    case RayPart::outside:
      inside = entry.depth <= (outside_roots ? last : std::min(last, near_root));
      if (inside) break;
      if (far_root > entry.depth) entry = {far_root, Surface::far_root};
      inside = !outside_roots && entry.depth <= last;
      break;
    case RayPart::all:
      inside = !outside_roots && entry.depth <= last;
      break;
  }
  QuadricPixel result;
  if (!inside || beside) return result;
  result.covered = true;
  result.depth = static_cast<std::uint32_t>(entry.depth);
  result.surface = entry.surface;
  result.cap = entry.cap;
  result.normal = normal(words, pixel, root, entry);
  return result;
}

std::array<std::uint32_t, 3> QuadricPixelLogic::normal(const QuadricWords& words, const PixelWords& pixel,
                                                       std::uint64_t root, const Entry& entry) const {
  const auto mask = static_cast<std::uint32_t>(low_mask(depth_bits_));
  if (entry.surface == Surface::near_plane) return {0, 0, 1U << (depth_bits_ - 2)};
  std::array<std::uint32_t, 3> normal{};
  const auto fraction = static_cast<unsigned>(parameters_.multiplier_bits) - kMultiplierInteger;
  for (std::size_t i = 0; i < 3; ++i) {
    if (entry.surface == Surface::cap) {
      normal[i] = words.caps[entry.cap].normal[i] & mask;
      continue;
    }
    const auto product = static_cast<std::uint32_t>(
        (std::int64_t{words.normal_of_root[i]} * static_cast<std::int64_t>(root)) >> fraction);
    normal[i] = (entry.surface == Surface::far_root ? pixel.normal[i] + product : pixel.normal[i] - product) & mask;
  }
  return normal;
}

}  // namespace rastertlm::quadric_processor
