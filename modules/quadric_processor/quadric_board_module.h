// A quadric board: the quadric processors of one computation unit behind the same bus as its triangle processors.
#pragma once

#include "modules/object_processor/board_module.h"
#include "modules/quadric_processor/quadric_board.h"

namespace rastertlm::quadric_processor {

using QuadricBoardModule = object_processor::BoardModule<QuadricBoard>;

}  // namespace rastertlm::quadric_processor

extern template class rastertlm::object_processor::BoardModule<rastertlm::quadric_processor::QuadricBoard>;
