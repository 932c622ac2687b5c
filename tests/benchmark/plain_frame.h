// The same picture without a machine: what a good engineer would write by hand for one processor of today, to have
// something to measure the simulation against. This file is complete: it includes nothing of rastertlm.
//
// It draws frames of 512 x 512 pixels of triangles that lie on the screen, lit by one light, with the arithmetic of the
// default machine: vertices on a grid of 1/32 pixel, words of 24 bits, normals of 12, tables of the centred shading
// processor. Set-up in double; spans in closed form, eight lines at a time; depth and the nearest triangle in frame
// buffers; normals, pre-normalisation and lighting once for each visible pixel, a line at a time. Products of the
// dot-product units are multiplied and not looked up: that is faster, and gives the same words.
//
// It is compiled for several instruction sets: PLAIN_VARIANT names the namespace.
#if !defined(PLAIN_FRAME_TYPES)
#define PLAIN_FRAME_TYPES

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace plain {

inline constexpr int kSide = 512;  // columns and lines
inline constexpr int kMaterials = 16;
inline constexpr int kIndices = 1024;  // of a level table, a material

struct Corner {
  double position[3];
  double normal[3];
};
struct Triangle {
  Corner corner[3];
  std::uint32_t object;    // index of Pose::objects
  std::uint32_t material;  // 0..15
};
struct ObjectPose {
  double object_to_eye[4][4];  // by column
  double normal_to_eye[3][3];
};
struct Pose {
  double eye_to_clip[4][4];
  std::vector<ObjectPose> objects;
};
// As the shading processor's memories hold them; loaded before the clock starts.
struct Tables {
  std::vector<std::uint16_t> inverse_root;  // 2^14 words of 12 bits
  std::uint32_t light_word[2][3];           // 0..2048: of N.L and N.H
  bool negative[2][3];                      // and their signs
  std::vector<std::uint8_t> diffuse[3];     // 16 x 1024 levels a channel
  std::vector<std::uint8_t> specular;       // 16 x 1024 levels
  std::vector<std::uint8_t> ambient;        // 3 a material
  std::uint8_t background[3];
};

struct Counts {
  std::uint64_t covered = 0;  // pixels, summed over triangles
  std::uint64_t visible = 0;  // pixels with a triangle
};
// Nanoseconds of the parts of a frame.
struct Parts {
  double set_up = 0;
  double spans = 0;    // and depth
  double shading = 0;  // and normals
};

class Loop {
 public:
  virtual ~Loop() = default;
  // False where a corner leaves the screen: this loop does not clip. `rgb`: 3 bytes a pixel, and 64 to spare.
  virtual bool frame(const Pose& pose, std::uint8_t* rgb) = 0;
  virtual Counts counts() = 0;  // of the last frame
  // A frame in parts, each timed.
  virtual Parts timed(const Pose& pose, std::uint8_t* rgb) = 0;
};

}  // namespace plain
#endif

#if defined(PLAIN_VARIANT)

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#if defined(__AVX512BW__)
#include <immintrin.h>
#endif

namespace plain::PLAIN_VARIANT {
namespace {

constexpr std::uint32_t kMask = 0xFFFFFF;
constexpr int kGridBits = 5;
constexpr double kGrid = 1 << kGridBits;
constexpr std::int64_t kLast = std::int64_t{kSide - 1} << kGridBits;
constexpr double kNear = (2 * kSide + 3) / 4 + 1;
constexpr double kDepthRange = static_cast<double>((1 << 24) - 2) - 2 * kNear;
constexpr double kNormalUnit = 1 << 22;

std::int64_t rounded(double value) { return static_cast<std::int64_t>(std::floor(value + 0.5)); }

double worked() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

struct Plane {
  std::uint32_t a, b, c;  // a x + b y + c
};

// A triangle on the screen. Edges by side: a line's pixels are those not left of an edge that rises and not right of
// one that falls; where there is one of a kind only, it stands twice.
struct Drawn {
  double slope[4], offset[4];  // column of the edge on line y: slope * y + offset; 0, 1 on the left, 2, 3 on the right
  std::int32_t first, last;    // lines
  Plane depth;
  Plane normal[3];
  std::uint32_t material;
};

class FrameLoop final : public Loop {
 public:
  FrameLoop(std::vector<Triangle> triangles, const Tables& tables)
      : triangles_(std::move(triangles)),
        drawn_(triangles_.size()),
        depth_(kSide * kSide + kSpare),
        winner_(kSide * kSide + kSpare) {
    for (auto& normal : normal_) normal.resize(kSide + kSpare);
    base_.resize(kSide + kSpare);
    load(tables);
  }

  bool frame(const Pose& pose, std::uint8_t* rgb) override {
    if (!set_up(pose)) return false;
    draw();
    shade(rgb);
    return true;
  }

  Parts timed(const Pose& pose, std::uint8_t* rgb) override {
    const double start = worked();
    set_up(pose);
    const double spans = worked();
    draw();
    const double shading = worked();
    shade(rgb);
    return {spans - start, shading - spans, worked() - shading};
  }

  Counts counts() override {
    Counts counts;
    for (std::size_t t = 0; t < drawn_count_; ++t) {
      const Drawn& d = drawn_[t];
      for (std::int32_t y = d.first; y <= d.last; y += 8) {
        std::int32_t begin[8], end[8];
        spans(d, y, begin, end);
        for (std::int32_t i = 0; i < 8 && y + i <= d.last; ++i)
          if (begin[i] < end[i]) counts.covered += static_cast<std::uint64_t>(end[i] - begin[i]);
      }
    }
    for (std::size_t i = 0; i < kSide * kSide; ++i) counts.visible += winner_[i] != 0 ? 1 : 0;
    return counts;
  }

 private:
  static constexpr std::size_t kSpare = 64;  // vectors may run over the end

  void load(const Tables& tables) {
    root_.assign(tables.inverse_root.begin(), tables.inverse_root.end());
    root_.push_back(0);  // gathers read two words
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 3; ++i) {
        light_[k][i] = static_cast<std::uint16_t>(tables.light_word[k][i]);
        flip_[k][i] = tables.negative[k][i] ? 0xFFFF : 0;
      }
    // Ambient light and diffuse levels saturate together, in any order.
    diffuse_.resize(kMaterials * kIndices);
    specular_.resize(kMaterials * kIndices);
    ambient_.resize(kMaterials);
    for (std::size_t i = 0; i < kMaterials * kIndices; ++i) {
      std::uint32_t word = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t sum = tables.diffuse[c][i] + std::uint32_t{tables.ambient[3 * (i / kIndices) + c]};
        word |= (sum < 255 ? sum : 255) << (8 * c);
      }
      diffuse_[i] = word;
      specular_[i] = tables.specular[i] * 0x010101U;
    }
    for (std::size_t m = 0; m < kMaterials; ++m)
      ambient_[m] = tables.ambient[3 * m] | tables.ambient[3 * m + 1] << 8 | tables.ambient[3 * m + 2] << 16;
    background_ =
        tables.background[0] | std::uint32_t{tables.background[1]} << 8 | std::uint32_t{tables.background[2]} << 16;
  }

  bool set_up(const Pose& pose) {
    clip_.resize(pose.objects.size());
    for (std::size_t o = 0; o < pose.objects.size(); ++o)
      for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
          double sum = pose.eye_to_clip[0][row] * pose.objects[o].object_to_eye[column][0];
          for (int k = 1; k < 4; ++k) sum += pose.eye_to_clip[k][row] * pose.objects[o].object_to_eye[column][k];
          clip_[o].m[column][row] = sum;
        }
    drawn_count_ = 0;
    bool inside = true;
    for (const Triangle& triangle : triangles_) inside = set_up(triangle, pose) && inside;
    return inside;
  }

  bool set_up(const Triangle& triangle, const Pose& pose) {
    const auto& m = clip_[triangle.object].m;
    const auto& n = pose.objects[triangle.object].normal_to_eye;
    std::int64_t px[3], py[3];
    double depth[3], normal[3][3];  // normal: by component, by corner
    for (int i = 0; i < 3; ++i) {
      const double* p = triangle.corner[i].position;
      const double* v = triangle.corner[i].normal;
      double clip[4];
      for (int r = 0; r < 4; ++r) clip[r] = m[0][r] * p[0] + m[1][r] * p[1] + m[2][r] * p[2] + m[3][r];
      for (int r = 0; r < 3; ++r) {
        const double component = n[0][r] * v[0] + n[1][r] * v[1] + n[2][r] * v[2];
        normal[r][i] = (component < -1.0 ? -1.0 : component > 1.0 ? 1.0 : component) * kNormalUnit;
      }
      if (!(clip[2] >= 0 && clip[2] <= clip[3])) return false;
      const double w = 1.0 / clip[3];
      px[i] = rounded((clip[0] * w * (kSide / 2.0) + (kSide / 2.0 - 0.5)) * kGrid);
      py[i] = rounded(((kSide / 2.0 - 0.5) - clip[1] * w * (kSide / 2.0)) * kGrid);
      const double z = clip[2] * w;
      depth[i] = (z < 0.0 ? 0.0 : z > 1.0 ? 1.0 : z) * kDepthRange + kNear;
    }
    const std::int64_t e1x = px[1] - px[0], e1y = py[1] - py[0], e2x = px[2] - px[0], e2y = py[2] - py[0];
    const std::int64_t area = e1x * e2y - e2x * e1y;
    const auto [left, right] = std::minmax({px[0], px[1], px[2]});
    const auto [top, bottom] = std::minmax({py[0], py[1], py[2]});
    if (left < 0 || right > kLast || top < 0 || bottom > kLast) return false;
    if (area >= 0) return true;  // turned away, or without area
    Drawn& d = drawn_[drawn_count_];
    d.first = static_cast<std::int32_t>((top + 31) >> kGridBits);
    d.last = static_cast<std::int32_t>(bottom >> kGridBits);
    int lefts = 0;
    int rights = 2;
    for (int e = 0; e < 3; ++e) {
      const int f = e == 2 ? 0 : e + 1;
      const std::int64_t a = py[f] - py[e];
      const std::int64_t b = px[e] - px[f];
      const bool top_left = a > 0 || (a == 0 && b > 0);
      const std::int64_t at_origin = -(a * px[e] + b * py[e]);
      const std::int64_t c = (top_left ? at_origin : at_origin - 1) >> kGridBits;
      if (a == 0) {  // b y + c >= 0
        if (b > 0) d.first = std::max(d.first, static_cast<std::int32_t>((-c + b - 1) / b));
        if (b < 0) d.last = std::min(d.last, static_cast<std::int32_t>(c / -b));
        continue;
      }
      // The column where the edge is 0, moved by less than the distance of any column from it: rounding then errs
      // nowhere.
      constexpr double kTiny = 1.0 / (1 << 20);
      int& side = a > 0 ? lefts : rights;
      const double inverse = 1.0 / static_cast<double>(a);
      d.slope[side] = static_cast<double>(-b) * inverse;
      d.offset[side] = static_cast<double>(-c) * inverse + (a > 0 ? -kTiny : kTiny);
      ++side;
    }
    if (lefts == 1) d.slope[1] = d.slope[0], d.offset[1] = d.offset[0];
    if (rights == 3) d.slope[3] = d.slope[2], d.offset[3] = d.offset[2];
    if (d.first > d.last) return true;

    const std::int64_t anchor_x = left + right, anchor_y = top + bottom;  // in units of 1/64 pixel
    const std::int64_t ax = anchor_x - 2 * px[0], ay = anchor_y - 2 * py[0];
    const double reciprocal = 1.0 / static_cast<double>(area);
    const double per_pixel = reciprocal * kGrid;
    const double half = reciprocal * 0.5;
    const double x1 = static_cast<double>(e1x) * per_pixel, y1 = static_cast<double>(e1y) * per_pixel;
    const double x2 = static_cast<double>(e2x) * per_pixel, y2 = static_cast<double>(e2y) * per_pixel;
    const double w1 = static_cast<double>(ax * e2y - ay * e2x) * half;
    const double w2 = static_cast<double>(ay * e1x - ax * e1y) * half;
    const auto fit = [&](const double(&v)[3]) {
      const double d1 = v[1] - v[0], d2 = v[2] - v[0];
      const std::int64_t a = rounded(d1 * y2 - d2 * y1);
      const std::int64_t b = rounded(d2 * x1 - d1 * x2);
      const std::int64_t sum = a * anchor_x + b * anchor_y;
      const std::int64_t whole = sum >> (kGridBits + 1);
      const double fraction = static_cast<double>(sum - whole * 64) / 64.0;
      const std::int64_t c = rounded(v[0] + d1 * w1 + d2 * w2 - fraction) - whole;
      return Plane{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
    };
    d.depth = fit(depth);
    for (int r = 0; r < 3; ++r) d.normal[r] = fit(normal[r]);
    d.material = triangle.material;
    ++drawn_count_;
    return true;
  }

  // Of the lines y .. y + 7.
  static void spans(const Drawn& d, std::int32_t y, std::int32_t* begin, std::int32_t* end) {
#if defined(__AVX512BW__)
    const __m512d line = _mm512_add_pd(_mm512_set1_pd(y), _mm512_setr_pd(0, 1, 2, 3, 4, 5, 6, 7));
    const auto column = [&](int i) {
      return _mm512_add_pd(_mm512_mul_pd(_mm512_set1_pd(d.slope[i]), line), _mm512_set1_pd(d.offset[i]));
    };
    const __m512d left = _mm512_max_pd(_mm512_max_pd(column(0), column(1)), _mm512_setzero_pd());
    const __m512d right = _mm512_min_pd(_mm512_min_pd(column(2), column(3)), _mm512_set1_pd(kSide - 0.5));
    const __m256i first = _mm512_cvt_roundpd_epi32(left, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
    const __m256i last = _mm512_cvt_roundpd_epi32(right, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(begin), first);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(end), _mm256_add_epi32(last, _mm256_set1_epi32(1)));
#else
    for (int i = 0; i < 8; ++i) {
      const double line = y + i;
      const auto column = [&](int k) { return d.slope[k] * line + d.offset[k]; };
      const double left = std::max(std::max(column(0), column(1)), 0.0);
      const double right = std::min(std::min(column(2), column(3)), kSide - 0.5);
      begin[i] = static_cast<std::int32_t>(std::ceil(left));
      end[i] = static_cast<std::int32_t>(std::floor(right)) + 1;
    }
#endif
  }

  void draw() {
    std::memset(depth_.data(), 0xFF, depth_.size() * sizeof(depth_[0]));
    std::memset(winner_.data(), 0, winner_.size() * sizeof(winner_[0]));
    for (std::size_t t = 0; t < drawn_count_; ++t) {
      const Drawn& d = drawn_[t];
      const auto mark = static_cast<std::uint32_t>(t + 1);
#if defined(__AVX512BW__)
      const __m512i ramp = _mm512_mullo_epi32(_mm512_set1_epi32(static_cast<int>(d.depth.a)),
                                              _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
      const __m512i marks = _mm512_set1_epi32(static_cast<int>(mark));
#endif
      for (std::int32_t y = d.first; y <= d.last; y += 8) {
        std::int32_t begin[8], end[8];
        spans(d, y, begin, end);
        const std::int32_t count = std::min(8, d.last - y + 1);
        for (std::int32_t i = 0; i < count; ++i) {
          if (begin[i] >= end[i]) continue;
          std::uint32_t* depth = depth_.data() + (y + i) * kSide;
          std::uint32_t* winner = winner_.data() + (y + i) * kSide;
          std::uint32_t word = d.depth.a * static_cast<std::uint32_t>(begin[i]) +
                               d.depth.b * static_cast<std::uint32_t>(y + i) + d.depth.c;
#if defined(__AVX512BW__)
          for (std::int32_t x = begin[i]; x < end[i]; x += 16) {
            const std::int32_t left = end[i] - x;
            const auto covered = static_cast<__mmask16>(left >= 16 ? 0xFFFFU : (1U << left) - 1);
            const __m512i words = _mm512_and_si512(_mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(word)), ramp),
                                                   _mm512_set1_epi32(kMask));
            const __m512i old = _mm512_loadu_si512(depth + x);
            const __mmask16 nearer = _mm512_mask_cmplt_epu32_mask(covered, words, old);
            _mm512_mask_storeu_epi32(depth + x, nearer, words);
            _mm512_mask_storeu_epi32(winner + x, nearer, marks);
            word += 16 * d.depth.a;
          }
#else
          for (std::int32_t x = begin[i]; x < end[i]; ++x) {
            const std::uint32_t here = word & kMask;
            const bool nearer = here < depth[x];
            depth[x] = nearer ? here : depth[x];
            winner[x] = nearer ? mark : winner[x];
            word += d.depth.a;
          }
#endif
        }
      }
    }
  }

  void shade(std::uint8_t* rgb) {
    for (std::int32_t y = 0; y < kSide; ++y) {
      const std::uint32_t* winner = winner_.data() + y * kSide;
      interpolate(winner, y);
      shade_line(winner, rgb + 3 * y * kSide);
    }
  }

  // Normals of a line, by runs of one triangle, from the left: what a vector writes too far is written again.
  void interpolate(const std::uint32_t* winner, std::int32_t y) {
    std::int32_t begin = 0;
    const auto run = [&](std::int32_t end) {
      const std::uint32_t mark = winner[begin];
      if (mark != 0) fill(drawn_[mark - 1], y, begin, end);
      begin = end;
    };
#if defined(__AVX512BW__)
    for (std::int32_t x = 0; x < kSide; x += 16) {
      std::uint32_t changes =
          _mm512_cmpneq_epu32_mask(_mm512_loadu_si512(winner + x), _mm512_loadu_si512(winner + x + 1));
      if (x + 16 == kSide) changes |= 0x8000U;
      for (; changes != 0; changes &= changes - 1) run(x + __builtin_ctz(changes) + 1);
    }
#else
    for (std::int32_t x = 1; x <= kSide; ++x)
      if (x == kSide || winner[x] != winner[begin]) run(x);
#endif
  }

  void fill(const Drawn& d, std::int32_t y, std::int32_t begin, std::int32_t end) {
    for (int r = 0; r < 3; ++r) {
      const Plane& plane = d.normal[r];
      std::uint32_t word =
          plane.a * static_cast<std::uint32_t>(begin) + plane.b * static_cast<std::uint32_t>(y) + plane.c;
      std::uint32_t* normal = normal_[r].data();
#if defined(__AVX512BW__)
      __m512i words =
          _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(word)),
                           _mm512_mullo_epi32(_mm512_set1_epi32(static_cast<int>(plane.a)),
                                              _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)));
      const __m512i step = _mm512_set1_epi32(static_cast<int>(16 * plane.a));
      for (std::int32_t x = begin; x < end; x += 16, words = _mm512_add_epi32(words, step))
        _mm512_storeu_si512(normal + x, words);
#else
      for (std::int32_t x = begin; x < end; ++x, word += plane.a) normal[x] = word;
#endif
    }
    const std::uint32_t base = d.material * kIndices;
#if defined(__AVX512BW__)
    for (std::int32_t x = begin; x < end; x += 16)
      _mm512_storeu_si512(base_.data() + x, _mm512_set1_epi32(static_cast<int>(base)));
#else
    for (std::int32_t x = begin; x < end; ++x) base_[static_cast<std::size_t>(x)] = base;
#endif
  }

#if defined(__AVX512BW__)
  struct Magnitudes {
    __m512i m[3], sign[3];
    __m512i root;
    __mmask16 zero;
  };
  Magnitudes magnitudes(std::size_t x) const {
    Magnitudes r;
    __m512i together = _mm512_set1_epi32(2047);
    for (int i = 0; i < 3; ++i) {
      const __m512i n = _mm512_slli_epi32(_mm512_loadu_si512(normal_[i].data() + x), 8);
      r.sign[i] = _mm512_srai_epi32(n, 31);
      r.m[i] = _mm512_xor_si512(_mm512_srai_epi32(n, 8), r.sign[i]);
      together = _mm512_or_si512(together, r.m[i]);
    }
    const __m512i shift = _mm512_sub_epi32(_mm512_set1_epi32(21), _mm512_lzcnt_epi32(together));
    __m512i squares = _mm512_setzero_si512();
    __m512i any = squares;
    for (int i = 0; i < 3; ++i) {
      r.m[i] = _mm512_srlv_epi32(r.m[i], shift);
      any = _mm512_or_si512(any, r.m[i]);
      squares = _mm512_add_epi32(squares, _mm512_madd_epi16(r.m[i], _mm512_add_epi32(r.m[i], _mm512_set1_epi32(1))));
    }
    r.zero = _mm512_cmpeq_epi32_mask(any, _mm512_setzero_si512());
    r.root = _mm512_and_si512(_mm512_i32gather_epi32(_mm512_srli_epi32(squares, 10), root_.data(), 2),
                              _mm512_set1_epi32(0xFFFF));
    return r;
  }

  void shade_line(const std::uint32_t* winner, std::uint8_t* rgb) const {
    const __m512i bytes = _mm512_set_epi8(  // of four bytes a pixel the first three
        -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 62, 61, 60, 58, 57, 56, 54, 53, 52, 50, 49, 48,
        46, 45, 44, 42, 41, 40, 38, 37, 36, 34, 33, 32, 30, 29, 28, 26, 25, 24, 22, 21, 20, 18, 17, 16, 14, 13, 12, 10,
        9, 8, 6, 5, 4, 2, 1, 0);
    const __m512i one = _mm512_set1_epi16(1);
    for (std::size_t x = 0; x < kSide; x += 32) {
      const Magnitudes low = magnitudes(x);
      const Magnitudes high = magnitudes(x + 16);
      const __m512i root = _mm512_packus_epi32(low.root, high.root);
      __m512i n[3], sign[3];
      for (int i = 0; i < 3; ++i) {
        const __m512i m = _mm512_packus_epi32(low.m[i], high.m[i]);
        sign[i] = _mm512_packs_epi32(low.sign[i], high.sign[i]);
        const __m512i twice = _mm512_add_epi16(_mm512_add_epi16(m, m), one);
        const __m512i product = _mm512_mulhi_epu16(_mm512_slli_epi16(twice, 4), root);
        const __m512i clamped = _mm512_min_epu16(product, _mm512_set1_epi16(2047));
        n[i] = _mm512_slli_epi16(_mm512_add_epi16(_mm512_add_epi16(clamped, clamped), one), 4);
      }
      const auto index = [&](int k) {
        __m512i sum = _mm512_setzero_si512();
        for (int i = 0; i < 3; ++i) {
          const __m512i entry = _mm512_mulhi_epu16(n[i], _mm512_set1_epi16(static_cast<short>(light_[k][i])));
          const __m512i flip = _mm512_xor_si512(sign[i], _mm512_set1_epi16(static_cast<short>(flip_[k][i])));
          sum = _mm512_add_epi16(sum, _mm512_xor_si512(entry, flip));
        }
        sum = _mm512_add_epi16(_mm512_add_epi16(sum, sum), _mm512_set1_epi16(3));
        sum = _mm512_min_epi16(_mm512_max_epi16(sum, _mm512_setzero_si512()), _mm512_set1_epi16(4095));
        return _mm512_srli_epi16(sum, 2);
      };
      const __m512i diffuse = index(0);
      const __m512i specular = index(1);
      const __m512i zero = _mm512_setzero_si512();
      const __m512i d[2] = {_mm512_unpacklo_epi16(diffuse, zero), _mm512_unpackhi_epi16(diffuse, zero)};
      const __m512i s[2] = {_mm512_unpacklo_epi16(specular, zero), _mm512_unpackhi_epi16(specular, zero)};
      for (std::size_t half = 0; half < 2; ++half) {
        const std::size_t at = x + 16 * half;
        const __m512i base = _mm512_loadu_si512(base_.data() + at);
        const __mmask16 seen = _mm512_cmpneq_epi32_mask(_mm512_loadu_si512(winner + at), zero);
        const __m512i background = _mm512_set1_epi32(static_cast<int>(background_));
        __m512i levels = background;
        if (seen != 0) {
          const __m512i dl =
              _mm512_mask_i32gather_epi32(background, seen, _mm512_add_epi32(base, d[half]), diffuse_.data(), 4);
          const __m512i sl =
              _mm512_mask_i32gather_epi32(zero, seen, _mm512_add_epi32(base, s[half]), specular_.data(), 4);
          levels = _mm512_adds_epu8(dl, sl);
          const __mmask16 dark = (half == 0 ? low.zero : high.zero) & seen;
          if (dark != 0)
            levels = _mm512_mask_i32gather_epi32(levels, dark, _mm512_srli_epi32(base, 10), ambient_.data(), 4);
        }
        const __m512i packed = _mm512_permutexvar_epi8(bytes, levels);
        _mm512_storeu_si512(rgb + 3 * at, packed);
      }
    }
  }
#else
  void shade_line(const std::uint32_t* winner, std::uint8_t* rgb) const {
    for (std::size_t x = 0; x < kSide; ++x) {
      std::uint32_t levels = background_;
      if (winner[x] != 0) {
        std::uint32_t m[3], sign[3];
        std::uint32_t together = 2047;
        for (int i = 0; i < 3; ++i) {
          const auto n = static_cast<std::int32_t>(normal_[i][x] << 8) >> 8;
          sign[i] = static_cast<std::uint32_t>(n >> 31);
          m[i] = static_cast<std::uint32_t>(n) ^ sign[i];
          together |= m[i];
        }
        const int shift = 21 - __builtin_clz(together);
        std::uint32_t squares = 0;
        for (auto& component : m) {
          component >>= shift;
          squares += component * (component + 1);
        }
        const std::uint32_t root = root_[squares >> 10];
        std::uint32_t index[2];
        for (int k = 0; k < 2; ++k) {
          std::int32_t sum = 0;
          for (int i = 0; i < 3; ++i) {
            const std::uint32_t product = ((2 * m[i] + 1) * root) >> 12;
            const std::uint32_t n = product < 2047 ? product : 2047;
            const std::uint32_t entry = ((2 * n + 1) * light_[k][i]) >> 12;
            sum += static_cast<std::int32_t>(entry ^ sign[i] ^ (flip_[k][i] != 0 ? ~0U : 0U));
          }
          sum = 2 * sum + 3;
          sum = sum < 0 ? 0 : sum;
          index[k] = static_cast<std::uint32_t>(sum < 4095 ? sum : 4095) >> 2;
        }
        if ((m[0] | m[1] | m[2]) == 0) {
          levels = ambient_[base_[x] / kIndices];
        } else {
          const std::uint32_t d = diffuse_[base_[x] + index[0]];
          const std::uint32_t s = specular_[base_[x] + index[1]] & 0xFF;
          levels = 0;
          for (int c = 0; c < 3; ++c) {
            const std::uint32_t sum = ((d >> (8 * c)) & 0xFF) + s;
            levels |= (sum < 255 ? sum : 255) << (8 * c);
          }
        }
      }
      for (std::size_t c = 0; c < 3; ++c) rgb[3 * x + c] = static_cast<std::uint8_t>(levels >> (8 * c));
    }
  }
#endif

  struct Matrix {
    double m[4][4];
  };
  std::vector<Triangle> triangles_;
  std::vector<Matrix> clip_;  // object to clip space
  std::vector<Drawn> drawn_;
  std::size_t drawn_count_ = 0;
  std::vector<std::uint32_t> depth_, winner_;  // winner: index of drawn_ + 1
  std::vector<std::uint32_t> normal_[3], base_;
  std::vector<std::uint16_t> root_;
  std::uint16_t light_[2][3] = {}, flip_[2][3] = {};
  std::vector<std::uint32_t> diffuse_, specular_, ambient_;
  std::uint32_t background_ = 0;
};

}  // namespace

std::unique_ptr<Loop> make(std::vector<Triangle> triangles, const Tables& tables) {
  return std::make_unique<FrameLoop>(std::move(triangles), tables);
}

}  // namespace plain::PLAIN_VARIANT

#endif
