// SQLite, as much of it as a store needs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

struct sqlite3;
struct sqlite3_stmt;

namespace rastertlm::explore {

class Database;

// A prepared statement. Parameters and columns count from 1 and 0, as SQLite has them.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  Statement& bind(int index, std::int64_t value);
  Statement& bind(int index, double value);
  Statement& bind(int index, std::string_view text);
  Statement& bind_blob(int index, std::string_view bytes);
  Statement& bind_null(int index);
  Statement& bind(int index, const std::optional<double>& value) {
    return value ? bind(index, *value) : bind_null(index);
  }

  // The next row; false at the end, after which the statement can be bound and run again.
  bool step();
  // Runs it to its end.
  void run();
  // As if it had not been stepped.
  void reset();
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;  // text or bytes
  bool is_null(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  void check(int code);
  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class Database {
 public:
  enum class Access { create, existing };
  // Opens the file, which is made where it may be and is not there. Throws InputError where it is no database, and
  // OutputError where it cannot be opened.
  Database(const std::string& file, Access access);
  void execute(const std::string& sql);
  std::int64_t integer(const std::string& sql);
  std::string text(const std::string& sql);
  std::int64_t last_row() const;
  // A statement that is kept for the next time, not stepped. One that may still be at work must not be asked for.
  Statement& kept(const std::string& sql);
  const std::string& file() const { return file_; }
  sqlite3* handle() const { return handle_.get(); }

  // Throws what an error code of SQLite means: a store that is damaged or is no database is InputError, everything
  // else, such as a full disk, OutputError. `doing` says what failed.
  [[noreturn]] void fail(int code, const std::string& doing) const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::string file_;
  std::unique_ptr<sqlite3, Close> handle_;
  std::unordered_map<std::string, Statement> kept_;
};

// All or nothing: rolled back unless it is committed.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database_.execute("BEGIN IMMEDIATE"); }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace rastertlm::explore
