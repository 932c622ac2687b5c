#include "src/cli/command.h"

// libsystemc asks for one, and has a main of its own that would call it: the program's main is the one below.
extern "C" int sc_main(int, char**) { return 0; }

int main(int argc, char** argv) { return static_cast<int>(rastertlm::cli::run(argc, argv)); }
