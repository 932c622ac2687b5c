// What to say about words that the command line does not know.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rastertlm::cli {

// "unknown sub-command 'rendr'; did you mean 'render'?", or all that is known where nothing is near.
std::string unknown_word(const std::string& kind, const std::string& word, const std::vector<std::string>& known);

// What is wrong with arguments that no option of `app` takes.
std::string left_over(const CLI::App& app, const std::vector<std::string>& words);

// Validators: an empty text, or what is wrong.
std::string finite_and_positive(const std::string& text);
std::string part_of_one(const std::string& text);  // a number from 0 to 1
std::string whole_from_one(const std::string& text);
std::string whole_up_to(const std::string& text, std::uint64_t most);  // from 1
std::string frame_number(const std::string& text);                     // 0 .. one less than whole_from_one() allows
std::string field_number(const std::string& text);                     // 0 or 1
std::string whole_range(const std::string& text);                      // FROM-TO
std::string not_empty(const std::string& text);
std::string pixels_a_degree(const std::string& text);  // what FLIP can be had at

std::string dotted_range(const std::string& text);  // A..B, or A alone

// FROM and TO of a text that dotted_range() has nothing against.
std::pair<std::uint64_t, std::uint64_t> dotted_range_of(const std::string& text);

// FROM and TO of a text that whole_range() has nothing against.
std::pair<std::uint64_t, std::uint64_t> range_of(const std::string& text);

// K and N of "K/N"; 1 and 0 of a text that is not two whole numbers.
std::pair<std::uint64_t, std::uint64_t> share_of(const std::string& text);

}  // namespace rastertlm::cli
