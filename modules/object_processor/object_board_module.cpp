#include "modules/object_processor/object_board_module.h"

namespace rastertlm::object_processor {

template class BoardModule<ObjectBoard>;

}  // namespace rastertlm::object_processor
