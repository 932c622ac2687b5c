# Reads the names of the files that one compilation read and prints, for the way from `source` to `target` along #include lines:
#   line in source TAB the headers between
# and line 1 and nothing where no such line leads there (a macro, or an option of the compiler).
{ read[++count] = $0 }

# What of the files read an include of `name` means; "" where none.
function resolve(name,   i) {
  for (i = 1; i <= count; ++i)
    if (read[i] == name || (length(read[i]) > length(name) && substr(read[i], length(read[i]) - length(name)) == "/" name)) return read[i]
  return ""
}

END {
  queue[1] = source
  seen[source] = 1
  for (head = tail = 1; head <= tail && !(target in seen); ++head) {
    file = queue[head]
    number = 0
    while ((getline text < file) > 0) {
      ++number
      if (text !~ /^[ \t]*#[ \t]*include/ || !match(text, /[<"][^>"]*/)) continue
      next_file = resolve(substr(text, RSTART + 1, RLENGTH - 1))
      if (next_file == "" || (next_file in seen)) continue
      seen[next_file] = 1
      queue[++tail] = next_file
      line[next_file] = (file == source) ? number : line[file]
      way[next_file] = (file == source) ? "" : (way[file] == "" ? "" : way[file] ", ") short(file)
    }
    close(file)
  }
  if (target in line) print line[target] "\t" way[target]
  else print "1\t"
}

function short(file,   name) {
  name = file
  if (index(name, root "/") == 1) name = substr(name, length(root) + 2)
  return name
}
