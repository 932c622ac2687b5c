// Beside the words of a slot, on the bus: the object that they belong to. An observer's mark, in no budget.
#pragma once

#include <cstdint>
#include <tlm>

namespace rastertlm::object_processor {

struct ObjectNumber : tlm::tlm_extension<ObjectNumber> {
  std::uint32_t object = 0;  // from 1; 0: none
  tlm::tlm_extension_base* clone() const override { return new ObjectNumber(*this); }
  void copy_from(const tlm::tlm_extension_base& other) override {
    object = static_cast<const ObjectNumber&>(other).object;
  }
};

}  // namespace rastertlm::object_processor
