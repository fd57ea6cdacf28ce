-- Tables of results, by name: <program>, <program>_<part>, or published/table_5_3 for the printed numbers.

local links = require "links"
local manifest = require "manifest"
local records = require "records"
local support = require "support"

local tables = {}
local loaded = {}

-- A table: `columns` maps a name to its unit and description, `order` lists the names, `rows` maps names to texts,
-- `numbers` maps rows to their numbers in the file, `file` is where the table is shipped, `program` what made it; a printed table has none.
function tables.load(name)
  if loaded[name] then return loaded[name] end
  local result = {name = name, columns = {}, order = {}, rows = {}, numbers = {}}
  local path, content
  if name:match("^published/") then
    path = support.source .. "/data/" .. name .. ".csv"
    content = support.read(path)
    result.file = links.ship("data/" .. name .. ".csv", path)
  else
    result.program = manifest.program_of(name)
    path = string.format("%s/%s/%s.csv", support.results, result.program, name)
    content = support.read(path, manifest.hint(result.program))
    result.file = links.ship(string.format("results/%s/%s.csv", result.program, name), path)
  end
  local described, header = {}, nil
  for line in content:gmatch("[^\r\n]+") do
    if line:match("^#") then
      local column, unit, description = line:match("^# ([%w_]+) %[(.-)%]: (.*)$")
      if column then described[column] = {unit = unit, description = description} end
    else
      local fields = support.split_line(line) or support.fail("%s: a quote is not closed in '%s'.", path, line)
      if header then
        local row = {}
        for i, column in ipairs(header) do
          row[column] = fields[i] or support.fail("%s: '%s' is too short.", path, line)
        end
        result.rows[#result.rows + 1] = row
        result.numbers[row] = #result.rows
      else
        header = fields
        for i, column in ipairs(header) do
          result.order[i] = column
          result.columns[column] = described[column] or {unit = "-", description = ""}
        end
      end
    end
  end
  if not header then support.fail("%s has no line of column names.", path) end
  loaded[name] = result
  return result
end

function tables.need(result, column)
  if not result.columns[column] then support.fail("the table '%s' has no column '%s'.", result.name, column) end
  return column
end

-- The same table with other columns or rows.
local function derive(result, rows)
  local copy = {}
  for key, value in pairs(result) do copy[key] = value end
  copy.columns, copy.order, copy.rows = {}, {}, rows
  for i, column in ipairs(result.order) do
    copy.order[i], copy.columns[column] = column, result.columns[column]
  end
  return copy
end

-- A table with a row for each value of the other columns in use and a column for each value of `key`, named after it,
-- that holds `value`: what stands below each other put side by side. `keep` lists the columns that tell rows apart.
function tables.spread(result, rows, keep, key, value)
  local wide = derive(result, {})
  local known = {}
  for _, row in ipairs(rows) do
    local parts = {}
    for _, column in ipairs(keep) do parts[#parts + 1] = row[column] end
    local name = table.concat(parts, "\n")
    if not known[name] then
      known[name] = {}
      for _, column in ipairs(keep) do known[name][column] = row[column] end
      wide.rows[#wide.rows + 1] = known[name]
    end
    local column = row[tables.need(result, key)]
    wide.columns[column] = result.columns[tables.need(result, value)]
    if known[name][column] then support.fail("the table '%s' has two rows for '%s'.", result.name, column) end
    known[name][column] = row[value]
  end
  for _, row in ipairs(wide.rows) do
    for column in pairs(wide.columns) do row[column] = row[column] or "" end
  end
  return wide
end

local function meaning(result, column)
  local described = result.columns[column]
  return column .. " [" .. described.unit .. "]" .. (described.description ~= "" and ": " or "") .. described.description
end

-- What a person sees who rests on a number: the expression where it is more than a column, the columns it is made of,
-- each with its unit, and which row, file, source and command it comes from. `fields` lists tables and columns, `place`
-- says which row.
function tables.origin(result, source, fields, place)
  local lines = {}
  if #fields ~= 1 or fields[1][2] ~= source then lines[1] = source .. (#fields == 0 and " [-]" or "") end
  for _, field in ipairs(fields) do
    local other = field[1].file ~= result.file and ", file " .. field[1].file or ""
    lines[#lines + 1] = meaning(field[1], field[2]) .. other
  end
  if place then lines[#lines + 1] = "row " .. place end
  lines[#lines + 1] = "file " .. result.file
  if result.program then
    lines[#lines + 1] = "source " .. manifest.source_of(result.program)
    lines[#lines + 1] = "command " .. manifest.command(result.program)
  end
  return table.concat(lines, "\n")
end

-- The same for a cell of a table, in short: the heading and the caption say the rest.
function tables.origin_of_cell(result, source, fields, place)
  local columns = {}
  for i, field in ipairs(fields) do columns[i] = field[2] .. " [" .. field[1].columns[field[2]].unit .. "]" end
  local what = #fields == 1 and fields[1][2] == source and columns[1] or source .. "\nof " .. table.concat(columns, ", ")
  return what .. "\nrow " .. place .. "\nfile " .. result.file:match("[^/]+$")
end

-- For the heading of a column: what it is.
function tables.origin_of_column(source, fields)
  local lines = {}
  if #fields ~= 1 or fields[1][2] ~= source then lines[1] = source end
  for _, field in ipairs(fields) do lines[#lines + 1] = meaning(field[1], field[2]) end
  return table.concat(lines, "\n")
end

return tables
