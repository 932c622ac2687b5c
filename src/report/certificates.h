// What `rastertlm certify` found of a machine: the proved worst error of each step beside the worst that was seen.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rastertlm::report {

inline constexpr std::int64_t kCertificatesSchema = 1;

// exhaustive: the machine's own core on every input. interval: interval arithmetic over ranges of inputs. formula: a
// closed form, whose derivation stands where `source` says.
enum class ProofKind { exhaustive, interval, formula };
const char* name_of(ProofKind kind);

struct Certificate {
  std::string step;     // "inverse square root"
  std::string decides;  // the parameter of the machine: "shading.normaliser_address_bits"
  std::string range;    // of the inputs that the proof speaks of
  ProofKind proof = ProofKind::formula;
  std::string source;  // where the derivation stands
  std::string unit;
  double proved = 0.0;       // the error's largest absolute value; infinite where nothing is proved
  double seen = 0.0;         // the largest on the inputs that were tried, on the machine's own core
  std::uint64_t inputs = 0;  // that were tried
  bool holds() const { return seen <= proved; }
};

// Of one width: what the proof says of its step alone, every other step exact.
struct GuardBits {
  std::string parameter;
  std::int64_t bits = 0;  // of the machine
  struct Share {
    double proved = 0.0;                // levels, with the machine's bits
    std::optional<std::int64_t> least;  // the fewest that keep to the wanted error; none that the machine can have does
  };
  std::vector<Share> shares;  // a quantity
};

struct Certificates {
  std::string machine;  // the file
  std::string platform;
  std::uint64_t seed = 0;
  std::vector<Certificate> steps;
  double wanted_levels = 0.0;
  std::vector<std::string> quantities;  // what an error is meant of: "diffuse", "exponent 50"
  std::vector<GuardBits> guard_bits;
  bool hold() const;
};

// Tables for a reader.
std::string certificates_text(const Certificates& certificates);
// A JSON list of machines, each {schema, program, kind, machine, platform, seed, holds, steps[], wanted_levels,
// guard_bits[]}; numbers of nine digits, null for infinity and for a width that does not exist.
std::string certificates_json(const std::vector<Certificates>& machines);

}  // namespace rastertlm::report
