#include "modules/quadric_processor/quadric_board_module.h"

template class rastertlm::object_processor::BoardModule<rastertlm::quadric_processor::QuadricBoard>;
