#include "src/explore/store.h"

#include <fmt/format.h>

#include <ctime>
#include <filesystem>

#include "src/base/digest.h"
#include "src/base/errors.h"
#include "src/explore/figures.h"
#include "src/report/figure_path.h"
#include "src/report/text_file.h"

namespace rastertlm::explore {
namespace {

constexpr std::int64_t kApplication = 0x52544C4D;  // "RTLM"

constexpr const char* kTables = R"(
CREATE TABLE sweep(id INTEGER PRIMARY KEY, entered INTEGER NOT NULL, digest TEXT NOT NULL UNIQUE, name TEXT NOT NULL,
  question TEXT NOT NULL, points INTEGER NOT NULL, baseline INTEGER);
CREATE TABLE axis(sweep INTEGER, position INTEGER, path TEXT NOT NULL, unit TEXT NOT NULL,
  given INTEGER NOT NULL, PRIMARY KEY(sweep, position)) WITHOUT ROWID;
CREATE TABLE choice(sweep INTEGER, axis INTEGER, position INTEGER, text TEXT NOT NULL, curve TEXT NOT NULL,
  PRIMARY KEY(sweep, axis, position)) WITHOUT ROWID;
CREATE TABLE objective(sweep INTEGER, position INTEGER, path TEXT NOT NULL, unit TEXT NOT NULL, sense TEXT NOT NULL,
  name TEXT NOT NULL, logarithmic INTEGER NOT NULL, PRIMARY KEY(sweep, position)) WITHOUT ROWID;
CREATE TABLE further(sweep INTEGER, position INTEGER, path TEXT NOT NULL, unit TEXT NOT NULL, name TEXT NOT NULL,
  PRIMARY KEY(sweep, position)) WITHOUT ROWID;
CREATE TABLE condition(sweep INTEGER, position INTEGER, text TEXT NOT NULL, PRIMARY KEY(sweep, position)) WITHOUT ROWID;
CREATE TABLE point(sweep INTEGER, number INTEGER, choices TEXT NOT NULL, result INTEGER,
  PRIMARY KEY(sweep, number)) WITHOUT ROWID;
CREATE TABLE result(id INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE, state TEXT NOT NULL, error TEXT NOT NULL,
  config_digest TEXT NOT NULL, scene_digest TEXT NOT NULL, seconds REAL NOT NULL, recorded TEXT NOT NULL,
  session INTEGER NOT NULL, report BLOB NOT NULL, picture TEXT NOT NULL);
CREATE TABLE figure(result INTEGER, path TEXT, value REAL, PRIMARY KEY(result, path)) WITHOUT ROWID;
CREATE TABLE configuration(digest TEXT PRIMARY KEY, toml BLOB NOT NULL);
CREATE TABLE picture(digest TEXT PRIMARY KEY, png BLOB NOT NULL);
CREATE TABLE session(id INTEGER PRIMARY KEY, sweep INTEGER NOT NULL, began TEXT NOT NULL, started INTEGER NOT NULL);
)";

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&time, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

// Who makes a store makes the folders above it.
std::string with_folders(const std::string& file, Store::Opening opening) {
  std::error_code error;
  const bool there = std::filesystem::exists(file, error);
  if (opening == Store::Opening::look && !there) throw InputError(Diagnostic{file, 0, "", "no such store"});
  if (opening == Store::Opening::fresh && there)
    throw InputError(Diagnostic{file, 0, "",
                                "is there already: --resume goes on with it and simulates what it lacks; or name "
                                "another --store"});
  if (std::filesystem::is_directory(file, error)) throw InputError(Diagnostic{file, 0, "", "is a directory"});
  if (opening != Store::Opening::look) report::make_folder_of(file);
  return file;
}

const char* state_text(State state) { return state == State::failed ? "failed" : "done"; }
State state_of(const std::string& text) { return text == "failed" ? State::failed : State::done; }

std::string choices_text(const std::vector<std::size_t>& choices) {
  std::string text;
  for (const std::size_t choice : choices) text += fmt::format("{}{}", text.empty() ? "" : " ", choice);
  return text;
}

}  // namespace

Store::Store(const std::string& file, Opening opening)
    : lock_((with_folders(file, opening), opening == Opening::look ? nullptr : std::make_unique<StoreLock>(file))),
      database_(file, opening == Opening::look ? Database::Access::existing : Database::Access::create) {
  check_header(opening);
  const std::string check = database_.text("PRAGMA quick_check(1)");
  if (check != "ok")
    throw InputError(Diagnostic{file, 0, "", fmt::format("the store is damaged ({}); nothing was changed", check)});
  if (opening == Opening::look) return;
  // Readers go on while a result is added, and a kill or a power cut leaves the results before it.
  database_.text("PRAGMA journal_mode = WAL");
  database_.execute("PRAGMA synchronous = NORMAL");
  if (database_.integer("SELECT count(*) FROM sqlite_master") == 0) make_schema();
}

void Store::check_header(Opening opening) {
  const std::int64_t application = database_.integer("PRAGMA application_id");
  const std::int64_t schema = database_.integer("PRAGMA user_version");
  const bool empty = database_.integer("SELECT count(*) FROM sqlite_master") == 0;
  if (empty && application == 0 && opening != Opening::look) return;
  if (application != kApplication)
    throw InputError(Diagnostic{database_.file(), 0, "", "is a database, but no store of rastertlm"});
  if (schema != kStoreSchema)
    throw InputError(Diagnostic{database_.file(), 0, "schema",
                                fmt::format("the store is of schema {}, and this program reads {}; nothing was changed",
                                            schema, kStoreSchema)});
}

void Store::make_schema() {
  Transaction transaction(database_);
  database_.execute(kTables);
  database_.execute(fmt::format("PRAGMA application_id = {}", kApplication));
  database_.execute(fmt::format("PRAGMA user_version = {}", kStoreSchema));
  transaction.commit();
}

std::int64_t Store::enter(const Sweep& sweep, const Design& design, const std::string& digest) {
  Statement find(database_, "SELECT id FROM sweep WHERE digest = ?");
  Transaction transaction(database_);
  std::int64_t id = 0;
  if (find.bind(1, digest).step()) {
    id = find.integer(0);
    find.run();
  } else {
    add_sweep(sweep, design, digest);
    id = database_.integer("SELECT max(id) FROM sweep");
  }
  Statement(database_, "UPDATE sweep SET entered = (SELECT max(entered) + 1 FROM sweep) WHERE id = ?")
      .bind(1, id)
      .run();
  transaction.commit();
  return id;
}

void Store::add_sweep(const Sweep& sweep, const Design& design, const std::string& digest) {
  Statement add(database_,
                "INSERT INTO sweep(entered, digest, name, question, points, baseline) VALUES (0, ?, ?, ?, ?, ?)");
  add.bind(1, digest).bind(2, sweep.name).bind(3, sweep.question);
  add.bind(4, static_cast<std::int64_t>(design.size()));
  if (design.baseline())
    add.bind(5, static_cast<std::int64_t>(*design.baseline()));
  else
    add.bind_null(5);
  add.run();
  const std::int64_t id = database_.last_row();
  Statement axis(database_, "INSERT INTO axis VALUES (?, ?, ?, ?, ?)");
  Statement choice(database_, "INSERT INTO choice VALUES (?, ?, ?, ?, ?)");
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    const auto place = static_cast<std::int64_t>(i);
    axis.bind(1, id).bind(2, place).bind(3, sweep.axes[i].path).bind(4, sweep.axes[i].unit);
    axis.bind(5, static_cast<std::int64_t>(sweep.axes[i].given)).run();
    for (std::size_t k = 0; k < sweep.axes[i].choices.size(); ++k)
      choice.bind(1, id)
          .bind(2, place)
          .bind(3, static_cast<std::int64_t>(k))
          .bind(4, sweep.axes[i].choices[k].text)
          .bind(5, sweep.axes[i].choices[k].curve)
          .run();
  }
  Statement objective(database_, "INSERT INTO objective VALUES (?, ?, ?, ?, ?, ?, ?)");
  for (std::size_t i = 0; i < sweep.objectives.size(); ++i) {
    const Objective& one = sweep.objectives[i];
    objective.bind(1, id).bind(2, static_cast<std::int64_t>(i)).bind(3, one.path).bind(4, one.unit);
    objective.bind(5, std::string(one.sense == Sense::minimise ? "minimise" : "maximise")).bind(6, one.name);
    objective.bind(7, static_cast<std::int64_t>(one.logarithmic)).run();
  }
  Statement column(database_, "INSERT INTO further VALUES (?, ?, ?, ?, ?)");
  for (std::size_t i = 0; i < sweep.further.size(); ++i) {
    const FurtherFigure& one = sweep.further[i];
    column.bind(1, id).bind(2, static_cast<std::int64_t>(i)).bind(3, one.path).bind(4, one.unit).bind(5, one.name);
    column.run();
  }
  Statement condition(database_, "INSERT INTO condition VALUES (?, ?, ?)");
  for (std::size_t i = 0; i < sweep.constraints.size(); ++i)
    condition.bind(1, id).bind(2, static_cast<std::int64_t>(i)).bind(3, sweep.constraints[i].text).run();
  Statement point(database_, "INSERT INTO point(sweep, number, choices) VALUES (?, ?, ?)");
  for (std::uint64_t number = 0; number < design.size(); ++number)
    point.bind(1, id).bind(2, static_cast<std::int64_t>(number)).bind(3, choices_text(design.point(number))).run();
}

std::optional<KnownResult> Store::find(const std::string& key) {
  Statement& statement = database_.kept("SELECT id, state, error FROM result WHERE key = ?");
  if (!statement.bind(1, key).step()) return std::nullopt;
  KnownResult known{statement.integer(0), state_of(statement.text(1)), statement.text(2)};
  statement.reset();
  return known;
}

std::int64_t Store::record(const PointResult& result, std::int64_t sweep, const std::vector<std::uint64_t>& numbers) {
  Transaction transaction(database_);
  const std::optional<KnownResult> before = find(result.key);
  if (before && before->state == State::done)
    throw ModelError("store", 0, fmt::format("internal check: the configuration {} was simulated twice", result.key));
  if (before) {
    Statement(database_, "DELETE FROM figure WHERE result = ?").bind(1, before->id).run();
    Statement(database_, "DELETE FROM result WHERE id = ?").bind(1, before->id).run();
  }
  Statement& add = database_.kept(
      "INSERT INTO result(id, key, state, error, config_digest, scene_digest, seconds, recorded, session, "
      "report, picture) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (before)
    add.bind(1, before->id);
  else
    add.bind_null(1);
  add.bind(2, result.key).bind(3, std::string(state_text(result.state))).bind(4, result.error);
  add.bind(5, result.config_digest).bind(6, result.scene_digest).bind(7, result.seconds).bind(8, now());
  add.bind(9, session_).bind_blob(10, result.report);
  add.bind(11, result.thumbnail.empty() ? std::string() : sha256_hex(result.thumbnail)).run();
  const std::int64_t id = database_.last_row();
  add_parts(result, id);
  database_.kept("UPDATE session SET started = ? WHERE id = ?").bind(1, started_).bind(2, session_).run();
  Statement& point = database_.kept("UPDATE point SET result = ? WHERE sweep = ? AND number = ?");
  for (const std::uint64_t number : numbers)
    point.bind(1, id).bind(2, sweep).bind(3, static_cast<std::int64_t>(number)).run();
  transaction.commit();
  return id;
}

void Store::add_parts(const PointResult& result, std::int64_t id) {
  Statement& figure = database_.kept("INSERT INTO figure VALUES (?, ?, ?)");
  for (const auto& [path, value] : result.figures) figure.bind(1, id).bind(2, path).bind(3, value).run();
  Statement& configuration = database_.kept("INSERT OR IGNORE INTO configuration VALUES (?, ?)");
  if (!result.machine_toml.empty()) configuration.bind(1, result.config_digest).bind_blob(2, result.machine_toml).run();
  if (!result.scene_toml.empty()) configuration.bind(1, result.scene_digest).bind_blob(2, result.scene_toml).run();
  if (result.thumbnail.empty()) return;
  Statement& picture = database_.kept("INSERT OR IGNORE INTO picture VALUES (?, ?)");
  picture.bind(1, sha256_hex(result.thumbnail)).bind_blob(2, result.thumbnail).run();
}

void Store::link(std::int64_t sweep, const std::vector<std::pair<std::uint64_t, std::int64_t>>& points) {
  if (points.empty()) return;
  Transaction transaction(database_);
  Statement point(database_, "UPDATE point SET result = ?1 WHERE sweep = ?2 AND number = ?3 AND result IS NOT ?1");
  for (const auto& [number, result] : points)
    point.bind(1, result).bind(2, sweep).bind(3, static_cast<std::int64_t>(number)).run();
  transaction.commit();
}

void Store::complete_figures(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::vector<std::pair<std::int64_t, std::optional<double>>> found;
    Statement lacking(database_,
                      "SELECT id FROM result WHERE state = 'done' AND NOT EXISTS (SELECT 1 FROM figure WHERE "
                      "figure.result = result.id AND figure.path = ?)");
    lacking.bind(1, path);
    while (lacking.step()) found.emplace_back(lacking.integer(0), figure(lacking.integer(0), path));
    if (found.empty()) continue;
    Transaction transaction(database_);
    Statement add(database_, "INSERT INTO figure VALUES (?, ?, ?)");
    for (const auto& [result, value] : found) add.bind(1, result).bind(2, path).bind(3, value).run();
    transaction.commit();
  }
}

void Store::begin_session(std::int64_t sweep) {
  Statement add(database_, "INSERT INTO session(sweep, began, started) VALUES (?, ?, 0)");
  add.bind(1, sweep).bind(2, now()).run();
  session_ = database_.last_row();
  started_ = 0;
}

bool Store::has_scene(const std::string& digest) {
  Statement& statement = database_.kept("SELECT 1 FROM configuration WHERE digest = ?");
  const bool there = statement.bind(1, digest).step();
  statement.reset();
  return there;
}

std::string Store::report(std::int64_t result) {
  Statement statement(database_, "SELECT report FROM result WHERE id = ?");
  const bool there = statement.bind(1, result).step();
  const std::string bytes = there ? statement.text(0) : std::string();
  return bytes.empty() ? bytes : expanded(bytes, database_.file());
}

std::optional<double> Store::figure(std::int64_t result, const std::string& path) {
  Statement stored(database_, "SELECT value FROM figure WHERE result = ? AND path = ?");
  if (stored.bind(1, result).bind(2, path).step())
    return stored.is_null(0) ? std::nullopt : std::optional(stored.real(0));
  const std::string text = report(result);
  if (text.empty()) return std::nullopt;
  Statement machine(database_,
                    "SELECT toml FROM configuration JOIN result ON digest = config_digest WHERE result.id = ?");
  const std::string toml = machine.bind(1, result).step() ? expanded(machine.text(0), database_.file()) : "";
  return figure_of(path, report::Figures(text, database_.file()), toml);
}

std::string Store::any_report() {
  const std::int64_t first = database_.integer("SELECT coalesce(min(id), 0) FROM result WHERE state = 'done'");
  return report(first);
}

}  // namespace rastertlm::explore
