// An object board: the triangle processors of one computation unit behind one bus.
#pragma once

#include "modules/object_processor/board_module.h"
#include "modules/object_processor/object_board.h"

namespace rastertlm::object_processor {

using ObjectBoardModule = BoardModule<ObjectBoard>;
extern template class BoardModule<ObjectBoard>;

}  // namespace rastertlm::object_processor
