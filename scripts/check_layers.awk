# The rules of scripts/check_layers. First file: the sources' names. Second, by mode:
#   includes: file TAB line TAB quote TAB name   -> "file:line: rule"
#   read:     object TAB source TAB file         -> object TAB source TAB file TAB rule   (what is forbidden even indirectly)

# src/NAME, modules/NAME, platforms/NAME, tests; "" for what is not ours.
function folder_of(file,   part) {
  split(file, part, "/")
  if (part[1] == "tests") return "tests"
  if (part[1] == "src" || part[1] == "modules" || part[1] == "platforms") return part[1] "/" part[2]
  return ""
}

# The SystemC half of a unit; the stream between units has no other.
function is_module_half(file) {
  return file ~ /^modules\/stream\// || file ~ /^modules\/.*(_module\.(h|cpp)|_payload\.h)$/
}

# The layer, or -1 where the folder has none.
function layer_of(file,   folder) {
  folder = folder_of(file)
  if (folder == "tests") return 99
  if (folder ~ /^modules\//) return is_module_half(file) ? 3 : 2
  if (folder ~ /^platforms\//) return 4
  return (folder in layer) ? layer[folder] : -1
}

function is_systemc(name) {
  return name ~ /(^|\/)(systemc|systemc\.h|tlm|tlm\.h)$/ || name ~ /(^|\/)(sysc|tlm_core|tlm_utils)\//
}

# Who may not see SystemC even indirectly; "" where it may.
function without_systemc(file,   folder) {
  folder = folder_of(file)
  if (folder == "src/reference") return "src/reference never sees SystemC"
  if (folder ~ /^modules\// && !is_module_half(file)) return "a core has no SystemC (only *_module, *_payload.h and modules/stream have)"
  if (layer_of(file) <= 2) return "no SystemC below layer 3"
  return ""
}

# Why `from` may not include `to`, both ours; "" where it may.
function why_not(from, to,   a, b, la, lb) {
  a = folder_of(from); b = folder_of(to)
  la = layer_of(from); lb = layer_of(to)
  if (a == "tests") return ""
  if (b == "tests") return "only tests see tests/"
  if (lb < 0) return b " is in no layer"
  if (a == "src/reference" && (b ~ /^modules\// || b ~ /^platforms\//)) return "src/reference never sees modules/ or platforms/"
  if (a == "src/report" && b == "src/run") return ""  # of one layer, but a report reads results; never the other way
  if (a == "platforms/adaptive" && b == "platforms/quadratic") return ""  # the same units behind another set-up
  if (lb > la) return "layer " la " (" a half(from) ") does not see layer " lb " (" b half(to) ")"
  if (lb == la && a != b && !(a ~ /^modules\// && b ~ /^modules\//))
    return "in a layer a file sees only its own folder: " a " does not see " b " (layer " la ")"
  return ""
}

function half(file) {
  if (folder_of(file) !~ /^modules\//) return ""
  return is_module_half(file) ? ", SystemC half" : ", core"
}

# Foreign headers that have one home; "" where this is it.
function foreign_rule(file, name) {
  if (is_systemc(name)) return without_systemc(file)
  if (name ~ /^OpenImageIO\// && file !~ /^(tests\/)?src\/image\/oiio_[^\/]*$/) return "OpenImageIO only in src/image/oiio_*"
  if (name ~ /^toml\+\+\// && file !~ /^(tests\/)?src\/config\//) return "toml++ only in src/config"
  if (name ~ /^nlohmann\// && file !~ /^(tests\/)?src\/report\//) return "nlohmann/json only in src/report"
  if (name ~ /^CLI\// && file !~ /^(tests\/)?src\/cli\//) return "CLI11 only in src/cli"
  if (name ~ /^(sqlite3|zlib)\.h$/ && file !~ /^(tests\/)?src\/explore\//) return "SQLite and zlib only in src/explore"
  return ""
}

function ours(name) { return name ~ /^(src|modules|platforms|tests)\// }

function refuse(file, line, rule) { if (rule != "") print file ":" line ": " rule }

BEGIN {
  layer["src/base"] = layer["src/parameter"] = 0
  layer["src/geometry"] = layer["src/frame"] = 1
  layer["src/scene"] = layer["src/image"] = layer["src/config"] = 2
  layer["src/reference"] = 3
  layer["src/run"] = layer["src/report"] = 5
  layer["src/analysis"] = layer["src/explore"] = 6
  layer["src/cli"] = 7
}

FILENAME == ARGV[1] {
  known[$0] = 1
  if (mode == "includes" && layer_of($0) < 0) refuse($0, 1, folder_of($0) " is in no layer")
  next
}

mode == "includes" {
  if (("/" $4 "/") ~ /\/\.\.\//) {
    refuse($1, $2, "no `..` in an include: it is written from the repository root (" $4 ")")
  } else if (ours($4)) {
    if ($3 == "<") refuse($1, $2, "a header of ours is included with quotes (" $4 ")")
    rule = why_not($1, $4)
    if (rule != "") refuse($1, $2, rule " (" $4 ")")
  } else if ($3 == "\"") {
    refuse($1, $2, "a header of ours is written from the repository root, another's in angle brackets (" $4 ")")
  } else {
    rule = foreign_rule($1, $4)
    if (rule != "") refuse($1, $2, rule " (" $4 ")")
  }
  next
}

mode == "read" {
  source = relative($2)
  if (!(source in known)) next
  file = relative($3)
  if (ours(file)) rule = why_not(source, file)
  else if (is_systemc(file)) rule = without_systemc(source)
  else if (file ~ /cmake_pch\.hxx$/) rule = precompiles_systemc($3) ? without_systemc(source) : ""
  else rule = ""
  # One line a source and rule: SystemC's own headers are hundreds.
  if (rule != "" && !((source, rule) in said)) {
    said[source, rule] = 1
    print $1 "\t" source "\t" $3 "\t" rule
  }
}

function relative(file) {
  if (index(file, root "/") == 1) return substr(file, length(root) + 2)
  if (named != "" && index(file, named "/") == 1) return substr(file, length(named) + 2)
  return file
}

# With a precompiled header the compiler does not name what is in it.
function precompiles_systemc(file,   text, found) {
  if (!(file in precompiled)) {
    found = 0
    while ((getline text < file) > 0) if (text ~ /^#include/ && match(text, /[<"][^>"]*/) && is_systemc(substr(text, RSTART + 1, RLENGTH - 1))) found = 1
    close(file)
    precompiled[file] = found
  }
  return precompiled[file]
}
