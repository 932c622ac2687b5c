// Numbers as the reports print them. Nothing here depends on a locale.
#pragma once

#include <cstdint>
#include <string>

namespace rastertlm::report {

// The nearest value that has `digits` significant decimal digits.
double to_significant(double value, int digits);
// Integers below 2^53 as they are, anything else with nine significant digits: what report.json holds of a quantity.
double to_stored(double value);

std::string grouped(std::uint64_t value);    // 333,333
std::string quantity(double value);          // 333,333 for integers, else four significant digits
std::string percent(double fraction);        // 81 %, 0.42 %, unlimited where it is infinite
std::string rate(double hz);                 // 50, 16.67
std::string frequency(double hz);            // 16.67 MHz
std::string bytes_per_second(double value);  // 27.34 MB/s
std::string bits(std::uint64_t count);       // 1,024 bits, 12.5 Kibit
std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural);  // 1 frame, 2 frames

}  // namespace rastertlm::report
