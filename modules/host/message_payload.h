// What the host processors say to each other over their serial links.
#pragma once

#include <cstdint>
#include <tlm>
#include <vector>

#include "modules/host/animation.h"
#include "modules/host/computation.h"
#include "modules/stream/line_payload.h"

namespace rastertlm::host {

// Free slots of one unit, as its survey reports them.
struct FreeSlots {
  std::uint32_t unit = 0;
  std::uint32_t count = 0;
};

struct Message {
  enum class Kind {
    frame,   // down: the animation unit's changes
    survey,  // up: whether a triangle of the subtree needs the guard band, and pieces that found no slot
    plan,    // down: the frame's grid, and who draws those pieces
  };
  Kind kind = Kind::frame;
  std::uint64_t bytes = 0;                                  // as they cross the link
  const FrameWork* work = nullptr;                          // frame; it stays until the next frame's
  bool guarded = false;                                     // survey, plan
  std::vector<FreeSlots> free_slots;                        // survey
  std::vector<Piece> homeless;                              // survey
  const std::vector<std::vector<Piece>>* placed = nullptr;  // plan: one list a unit
};

struct MessagePayload : tlm::tlm_generic_payload {
  Message message;
};

using HostProtocol = stream::Protocol<MessagePayload>;

inline constexpr std::uint64_t kFlagBytes = 1;
inline constexpr std::uint64_t kCountBytes = 4;
inline constexpr std::uint64_t kPieceBytes = 4 * (object_processor::kWords + 1);  // its words and its object
inline std::uint64_t survey_bytes(const Message& survey) {
  return kFlagBytes + kCountBytes * survey.free_slots.size() + kPieceBytes * survey.homeless.size();
}

}  // namespace rastertlm::host
