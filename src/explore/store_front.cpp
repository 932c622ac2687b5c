// The front of a store's sweep, kept beside its points for whoever reads the file with SQL.
#include "src/explore/front.h"
#include "src/explore/store.h"

namespace rastertlm::explore {

void Store::forget_front() { database_.execute("DROP TABLE IF EXISTS front"); }

void Store::keep_front() {
  Statement shown(database_, "SELECT id FROM sweep ORDER BY entered DESC LIMIT 1");
  if (!shown.step()) return;
  const std::int64_t sweep = shown.integer(0);
  shown.run();
  const SweepTable found = table();
  const Front front = find_front(found);
  Transaction transaction(database_);
  forget_front();
  database_.execute(
      "CREATE TABLE front(sweep INTEGER, number INTEGER, beaten_by INTEGER, PRIMARY KEY(sweep, number)) WITHOUT ROWID");
  Statement add(database_, "INSERT INTO front VALUES (?, ?, ?)");
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    if (!front.compared[i]) continue;
    add.bind(1, sweep).bind(2, static_cast<std::int64_t>(found.rows[i].number));
    if (front.beaten_by[i])
      add.bind(3, static_cast<std::int64_t>(found.rows[*front.beaten_by[i]].number));
    else
      add.bind_null(3);
    add.run();
  }
  transaction.commit();
}

}  // namespace rastertlm::explore
