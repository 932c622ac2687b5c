// Stores of one sweep joined.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "src/base/errors.h"
#include "src/explore/store.h"
#include "src/report/text_file.h"

namespace rastertlm::explore {
namespace {

constexpr std::array<const char*, 3> kEndings{"", "-wal", "-shm"};

void remove_store(const std::string& file) {
  for (const char* ending : kEndings) ::unlink((file + ending).c_str());
}

std::string shown_digest(Database& database) {
  return database.text("SELECT digest FROM sweep ORDER BY entered DESC LIMIT 1");
}

// What a store has that the joined one has not; `part` is the store's name in SQL. A failed point that another store
// has done is done.
constexpr std::array<const char*, 10> kJoin{
    "DELETE FROM main.figure WHERE result IN (SELECT r.id FROM main.result r JOIN part.result p ON p.key = r.key WHERE "
    "r.state = 'failed' AND p.state = 'done')",
    "UPDATE main.result SET (state, error, config_digest, scene_digest, seconds, recorded, session, report, picture) = "
    "(SELECT state, error, config_digest, scene_digest, seconds, recorded, session + (SELECT coalesce(max(id), 0) FROM "
    "main.session), report, picture FROM part.result p "
    "WHERE p.key = main.result.key) WHERE state = 'failed' AND key IN (SELECT key FROM part.result WHERE state = "
    "'done')",
    "INSERT INTO main.result(key, state, error, config_digest, scene_digest, seconds, recorded, session, report, "
    "picture) SELECT key, state, error, config_digest, scene_digest, seconds, recorded, session + (SELECT "
    "coalesce(max(id), 0) FROM main.session), report, picture FROM "
    "part.result p WHERE NOT EXISTS (SELECT 1 FROM main.result r WHERE r.key = p.key) ORDER BY id",
    "INSERT OR IGNORE INTO main.figure SELECT r.id, f.path, f.value FROM part.figure f JOIN part.result p ON p.id = "
    "f.result JOIN main.result r ON r.key = p.key WHERE r.state = 'done' OR p.state = 'failed'",
    "INSERT OR IGNORE INTO main.configuration SELECT digest, toml FROM part.configuration",
    "INSERT OR IGNORE INTO main.picture SELECT digest, png FROM part.picture",
    "INSERT OR IGNORE INTO main.sweep(entered, digest, name, question, points, baseline) SELECT 0, digest, name, "
    "question, points, baseline FROM part.sweep ORDER BY entered",
    "INSERT OR IGNORE INTO main.point(sweep, number, choices) SELECT s.id, q.number, q.choices FROM part.point q JOIN "
    "part.sweep t ON t.id = q.sweep JOIN main.sweep s ON s.digest = t.digest",
    "UPDATE main.point SET result = (SELECT r.id FROM part.point q JOIN part.sweep t ON t.id = q.sweep JOIN main.sweep "
    "s ON s.digest = t.digest JOIN part.result p ON p.id = q.result JOIN main.result r ON r.key = p.key WHERE s.id = "
    "point.sweep AND q.number = point.number) WHERE result IS NULL",
    "INSERT INTO main.session(id, sweep, began, started) SELECT id + (SELECT coalesce(max(id), 0) FROM main.session), "
    "0, began, started FROM part.session"};

// The axes, objectives and constraints of a sweep that is new here.
constexpr std::array<const char*, 5> kDescription{
    "INSERT OR IGNORE INTO main.axis SELECT s.id, position, path, unit, given FROM part.axis a JOIN part.sweep t ON "
    "t.id = "
    "a.sweep JOIN main.sweep s ON s.digest = t.digest",
    "INSERT OR IGNORE INTO main.choice SELECT s.id, axis, position, text, curve FROM part.choice a JOIN part.sweep t "
    "ON t.id "
    "= "
    "a.sweep JOIN main.sweep s ON s.digest = t.digest",
    "INSERT OR IGNORE INTO main.objective SELECT s.id, position, path, unit, sense, a.name, logarithmic FROM "
    "part.objective a JOIN part.sweep t ON t.id = a.sweep JOIN main.sweep s ON s.digest = t.digest",
    "INSERT OR IGNORE INTO main.further SELECT s.id, position, path, unit, a.name FROM part.further a JOIN part.sweep "
    "t "
    "ON t.id = a.sweep JOIN main.sweep s ON s.digest = t.digest",
    "INSERT OR IGNORE INTO main.condition SELECT s.id, position, text FROM part.condition a JOIN part.sweep t ON t.id "
    "= "
    "a.sweep JOIN main.sweep s ON s.digest = t.digest"};

// Two stores with the same configuration have the same report: the model gives no other.
void refuse_other_results(Database& joined, const std::string& name) {
  Statement other(joined,
                  "SELECT p.key FROM part.result p JOIN main.result r ON r.key = p.key WHERE p.state = 'done' AND "
                  "r.state = 'done' AND p.report <> r.report LIMIT 1");
  if (other.step())
    throw ModelError("merge", 0,
                     fmt::format("internal check: {} has another report of the configuration {} than a store before it",
                                 name, other.text(0)));
}

void join(Database& joined, const std::string& name) {
  Transaction transaction(joined);
  refuse_other_results(joined, name);
  for (const char* sql : kJoin) joined.execute(sql);
  for (const char* sql : kDescription) joined.execute(sql);
  transaction.commit();
}

Lacking lacking_of(Database& joined, const std::string& digest) {
  Lacking lacking;
  Statement point(joined,
                  "SELECT number, result IS NULL FROM point WHERE sweep = (SELECT id FROM sweep WHERE digest = ?) "
                  "ORDER BY number");
  point.bind(1, digest);
  while (point.step()) {
    ++lacking.points;
    if (point.integer(1) != 0) lacking.missing.push_back(static_cast<std::uint64_t>(point.integer(0)));
  }
  return lacking;
}

// Of so many shares, those that are missing as a whole, from 1; none where a share is missing in part.
std::vector<std::uint64_t> whole_shares(const Lacking& lacking, std::uint64_t shares) {
  std::vector<std::uint64_t> missing(shares, 0);
  for (const std::uint64_t number : lacking.missing) ++missing[number % shares];
  std::vector<std::uint64_t> whole;
  for (std::uint64_t share = 0; share < shares; ++share) {
    const std::uint64_t points = (lacking.points + shares - 1 - share) / shares;
    if (missing[share] == points)
      whole.push_back(share + 1);
    else if (missing[share] > 0)
      return {};
  }
  return whole;
}

}  // namespace

std::string lacking_text(const Lacking& lacking) {
  if (lacking.missing.empty()) return "";
  constexpr std::uint64_t kMostShares = 1000;
  std::string which = fmt::format("the first is point {}", lacking.missing.front());
  // A share of one point is a point: more than half as many shares tell nothing.
  for (std::uint64_t shares = 2; shares <= std::min(kMostShares, lacking.points / 2); ++shares) {
    const std::vector<std::uint64_t> whole = whole_shares(lacking, shares);
    if (whole.empty()) continue;
    which = "all of share";
    for (const std::uint64_t share : whole)
      which += fmt::format("{} {}/{}", share == whole.front() ? "" : ",", share, shares);
    break;
  }
  return fmt::format("{} of {} points {} no result: {}", lacking.missing.size(), lacking.points,
                     lacking.missing.size() == 1 ? "has" : "have", which);
}

Lacking merge_stores(const std::string& out, const std::vector<std::string>& stores) {
  std::error_code error;
  if (std::filesystem::exists(out, error))
    throw InputError(Diagnostic{out, 0, "", "is there already; name another, or remove it"});
  const std::string partial = fmt::format("{}.partial-{}", out, ::getpid());
  remove_store(partial);
  Lacking lacking;
  try {
    Store joined(partial, Store::Opening::fresh);
    std::string digest;
    for (const std::string& file : stores) {
      {
        if (!std::filesystem::exists(file, error)) throw InputError(Diagnostic{file, 0, "", "no such store"});
        Store part(file, Store::Opening::resume);  // nobody else adds to it meanwhile
        const std::string own = shown_digest(part.database());
        if (own.empty()) throw InputError(Diagnostic{file, 0, "", "the store holds no sweep yet"});
        if (digest.empty()) digest = own;
        if (own != digest)
          throw InputError(Diagnostic{file, 0, "", fmt::format("is of another sweep than {}", stores.front())});
        Statement attach(joined.database(), "ATTACH ? AS part");
        attach.bind(1, file).run();
        join(joined.database(), file);
        joined.database().execute("DETACH part");
      }
    }
    Statement shown(joined.database(), "UPDATE sweep SET entered = 1 WHERE digest = ?");
    shown.bind(1, digest).run();
    joined.keep_front();
    lacking = lacking_of(joined.database(), digest);
    joined.database().text("PRAGMA journal_mode = DELETE");  // one file
  } catch (...) {
    remove_store(partial);
    throw;
  }
  if (::rename(partial.c_str(), out.c_str()) != 0) {
    const int number = errno;
    remove_store(partial);
    throw OutputError(report::output_message(out, number));
  }
  return lacking;
}

}  // namespace rastertlm::explore
