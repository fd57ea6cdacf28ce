-- Draws tables, figures and numbers from the results into the report, by name. What is not there fails the build.
--
-- A number in a sentence:   `table_5_3_so_synthesis f_star workspace=P1 optimizer=dynamic_q`{.value format="%.3f"}
-- A setting of a program:   `table_5_3_so_synthesis --chord`{.setting}
--
-- A table:                  ``` {.table}
--                           table: table_5_3_so_synthesis
--                           where: optimizer=dynamic_q formulation=area
--                           column: workspace
--                           column: f_star | $f^*$ | %.4f
--                           column: f_star - published_f_star | difference | %+.4f
--                           caption: Markdown, with $formulas$.
--                           ```
-- A line "measured: workspace optimizer" gives the table a column `measured`: what the program measured under the name
-- made of these fields, such as a time. Without a heading a column has its own name, without a format it is shown as it is written; the format `text` is for
-- long texts. A table is <program>, <program>_<part>, or published/table_5_3 for the
-- printed numbers.
--
-- A figure:                 ``` {.figure}
--                           figure: figure_5_7_so_synthesis
--                           caption: ...
--                           ```
-- The manifest:             ``` {.manifest}
-- Where results come from:  ``` {.provenance}

local results, source

local function fail(...)
  io.stderr:write("paper: " .. string.format(...) .. "\n")
  os.exit(1)
end

local function read(path, hint)
  local file = io.open(path, "rb")
  if not file then fail("%s is not there%s.", path, hint or "") end
  local content = file:read("a")
  file:close()
  return content
end

local function trim(text) return (text:gsub("^%s+", ""):gsub("%s+$", "")) end

-- The manifest -------------------------------------------------------------------------------------------------------

local manifest

local function programs()
  if manifest then return manifest end
  manifest = {}
  for line in read(source .. "/experiments/manifest"):gmatch("[^\n]+") do
    if not line:match("^#") then
      local fields = {}
      for field in (line .. "|"):gmatch("(.-)|") do fields[#fields + 1] = trim(field) end
      manifest[#manifest + 1] = {program = fields[1], item = fields[2], title = fields[3]}
    end
  end
  return manifest
end

-- The program a result belongs to: the longest name in the manifest that the result's name begins with.
local function program_of(name)
  local found
  for _, row in ipairs(programs()) do
    local begins = name == row.program or name:sub(1, #row.program + 1) == row.program .. "_"
    if begins and (not found or #row.program > #found) then found = row.program end
  end
  if not found then fail("the manifest has no program for the result '%s'.", name) end
  return found
end

local function command(program) return "make experiment NAME=" .. program end

local function hint(program) return "; run '" .. command(program) .. "' first" end

-- Tables -------------------------------------------------------------------------------------------------------------

local function split_line(line)
  local fields, i = {}, 1
  while true do
    local field
    if line:sub(i, i) == '"' then
      local j = i + 1
      while true do
        j = line:find('"', j, true)
        if not j then return nil end
        if line:sub(j + 1, j + 1) ~= '"' then break end
        j = j + 2
      end
      field = line:sub(i + 1, j - 1):gsub('""', '"')
      i = j + 1
    else
      local j = line:find(",", i, true) or #line + 1
      field = line:sub(i, j - 1)
      i = j
    end
    fields[#fields + 1] = field
    if i > #line then return fields end
    i = i + 1
  end
end

local tables = {}

local function load_table(name)
  if tables[name] then return tables[name] end
  local path, content
  if name:match("^published/") then
    path = source .. "/data/" .. name .. ".csv"
    content = read(path)
  else
    local program = program_of(name)
    path = string.format("%s/%s/%s.csv", results, program, name)
    content = read(path, hint(program))
  end
  local loaded = {name = name, columns = {}, rows = {}}
  local header
  for line in content:gmatch("[^\r\n]+") do
    if not line:match("^#") then
      local fields = split_line(line) or fail("%s: a quote is not closed in '%s'.", path, line)
      if header then
        local row = {}
        for i, column in ipairs(header) do row[column] = fields[i] or fail("%s: '%s' is too short.", path, line) end
        loaded.rows[#loaded.rows + 1] = row
      else
        header = fields
        for _, column in ipairs(header) do loaded.columns[column] = true end
      end
    end
  end
  if not header then fail("%s has no line of column names.", path) end
  tables[name] = loaded
  return loaded
end

local function need_column(loaded, column)
  if not loaded.columns[column] then fail("the table '%s' has no column '%s'.", loaded.name, column) end
  return column
end

-- The rows that meet all of the conditions "column=text column=text".
local function select(loaded, conditions)
  local rows = loaded.rows
  for condition in conditions:gmatch("%S+") do
    local column, text = condition:match("^([%w_]+)=(.*)$")
    if not column then fail("'%s' is not a condition such as workspace=P1.", condition) end
    need_column(loaded, column)
    local kept = {}
    for _, row in ipairs(rows) do
      if row[column] == text then kept[#kept + 1] = row end
    end
    rows = kept
  end
  if #rows == 0 then fail("the table '%s' has no row with %s.", loaded.name, conditions) end
  return rows
end

-- A number as people write it: a true minus sign, and powers of ten in place of an exponent.
local function format_number(format, number)
  local text = string.format(format, number)
  local mantissa, exponent = text:match("^(.-)[eE]([+-]%d+)$")
  local digits = {["-"] = "⁻", ["0"] = "⁰", ["1"] = "¹", ["2"] = "²", ["3"] = "³", ["4"] = "⁴", ["5"] = "⁵",
    ["6"] = "⁶", ["7"] = "⁷", ["8"] = "⁸", ["9"] = "⁹"}
  if mantissa then
    text = mantissa .. " × 10" .. tostring(math.tointeger(tonumber(exponent))):gsub(".", digits)
  end
  return (text:gsub("%-", "−"))
end

-- The field of a row for "column" or "column - column"; an empty field stays empty.
local function field(loaded, row, expression, format)
  local first, second = expression:match("^([%w_]+)%s*%-%s*([%w_]+)$")
  if not first then first = expression:match("^[%w_]+$") or fail("'%s' is not a column.", expression) end
  local text = row[need_column(loaded, first)]
  if second then
    local subtrahend = row[need_column(loaded, second)]
    if text == "" or subtrahend == "" then return "" end
    text = (tonumber(text) or fail("'%s' is not a number.", text)) -
      (tonumber(subtrahend) or fail("'%s' is not a number.", subtrahend))
  end
  if text == "" then return "" end
  if format == nil or format == "" or format == "text" then
    return tonumber(text) and format_number("%s", text) or tostring(text)
  end
  local number = tonumber(text)
  if not number then fail("the table '%s', column '%s': '%s' is not a number.", loaded.name, expression, text) end
  if format:match("d$") then number = math.tointeger(number) or fail("'%s' is not a whole number.", text) end
  return format_number(format, number)
end

-- Records of provenance ----------------------------------------------------------------------------------------------

-- JSON as nlohmann-json writes it. (pandoc's own reader comes with its version 3.)
local function parse_json(text, path)
  local position = 1
  local value
  local function token(pattern)
    local found, stop = text:match("^%s*(" .. pattern .. ")()", position)
    if found then position = stop end
    return found
  end
  local function bad() fail("%s is not JSON at character %d.", path, position) end
  local function string_value()
    local parts = {}
    while true do
      local plain, mark, stop = text:match('^([^"\\]*)(["\\])()', position)
      if not plain then bad() end
      parts[#parts + 1] = plain
      position = stop
      if mark == '"' then return table.concat(parts) end
      local escape = text:sub(position, position)
      position = position + 1
      if escape == "u" then
        parts[#parts + 1] = utf8.char(tonumber(text:sub(position, position + 3), 16) or bad())
        position = position + 4
      else
        parts[#parts + 1] = ({n = "\n", t = "\t", r = "\r", b = "\b", f = "\f"})[escape] or escape
      end
    end
  end
  local function list(close, item)
    local items = {}
    if token(close) then return items end
    repeat item(items) until not token(",")
    return token(close) and items or bad()
  end
  value = function()
    if token("{") then
      return list("}", function(items)
        if not token('"') then bad() end
        local key = string_value()
        if not token(":") then bad() end
        items[key] = value()
      end)
    elseif token("%[") then
      return list("%]", function(items) items[#items + 1] = value() end)
    elseif token('"') then
      return string_value()
    end
    local word = token("[%w.+-]+") or bad()
    if word == "true" then return true end
    if word == "false" then return false end
    if word == "null" then return nil end
    return tonumber(word) or bad()
  end
  local result = value()
  if text:match("%S", position) then bad() end
  return result
end

-- The value of an option as people write it.
local function option_text(value, format)
  if type(value) == "number" then return format_number(format or "%.6g", value) end
  if type(value) ~= "table" then return tostring(value) end
  local items = {}
  for i, item in ipairs(value) do items[i] = option_text(item, format) end
  return table.concat(items, ", ")
end

local records = {}

local function load_record(program)
  if not records[program] then
    local path = string.format("%s/%s/%s.json", results, program, program)
    records[program] = parse_json(read(path, hint(program)), path)
  end
  return records[program]
end

-- What the report is made of -----------------------------------------------------------------------------------------

local function inlines(markdown)
  local blocks = pandoc.read(markdown, "markdown").blocks
  return #blocks == 0 and {} or pandoc.utils.blocks_to_inlines(blocks)
end

-- The lines "key: value" of a block; `allowed` lists the keys, `column` may come several times.
local function settings(block, allowed)
  local found = {column = {}}
  for line in block.text:gmatch("[^\n]+") do
    local key, value = line:match("^(%w+):%s*(.*)$")
    if not key or not allowed[key] then fail("'%s' is not understood in a block of the report.", line) end
    if key == "column" then table.insert(found.column, value) else found[key] = value end
  end
  return found
end

-- The caption stands above the part that scrolls on a narrow screen.
local function simple_table(caption, headings, alignments, rows)
  local widths = {}
  for i = 1, #headings do widths[i] = 0 end
  local function cells(texts)
    local row = {}
    for i, text in ipairs(texts) do
      row[i] = {pandoc.Plain(type(text) == "string" and {pandoc.Str(text)} or text)}
    end
    return row
  end
  local body = {}
  for i, row in ipairs(rows) do body[i] = cells(row) end
  local made = pandoc.SimpleTable({}, alignments, widths, cells(headings), body)
  local scroll = pandoc.Div({pandoc.utils.from_simple_table(made)}, pandoc.Attr("", {"scroll"}))
  return pandoc.Div(#caption > 0 and {pandoc.Para(caption), scroll} or {scroll}, pandoc.Attr("", {"wide"}))
end

local function data_link(name) return pandoc.Span({pandoc.Str("Data: "), pandoc.Code(name)}, pandoc.Attr("", {"made"})) end

local function made_by(program)
  return pandoc.Span({pandoc.Str("Made by "), pandoc.Code(command(program))}, pandoc.Attr("", {"made"}))
end

-- The table with a column `measured` from its program's record, under the name made of the fields of a row.
local function with_measured(loaded, columns)
  local program = program_of(loaded.name)
  local measured = load_record(program).measured or {}
  local extended = {name = loaded.name, columns = {measured = true}, rows = {}}
  for column in pairs(loaded.columns) do extended.columns[column] = true end
  for i, row in ipairs(loaded.rows) do
    local parts = {}
    for column in columns:gmatch("%S+") do parts[#parts + 1] = row[need_column(loaded, column)] end
    local name = table.concat(parts, " ")
    local copy = {}
    for column, text in pairs(row) do copy[column] = text end
    copy.measured = tostring(measured[name] or fail("the program '%s' has measured nothing named '%s'.", program, name))
    extended.rows[i] = copy
  end
  return extended
end

local function table_block(block)
  local spec = settings(block, {table = true, where = true, measured = true, column = true, caption = true})
  local loaded = load_table(spec.table or fail("a table of the report has no line 'table: ...'."))
  if spec.measured then loaded = with_measured(loaded, spec.measured) end
  local headings, alignments, columns = {}, {}, {}
  for i, text in ipairs(spec.column) do
    local parts = {}
    for part in (text .. "|"):gmatch("(.-)|") do parts[#parts + 1] = trim(part) end
    columns[i] = {expression = parts[1], format = parts[3]}
    alignments[i] = pandoc.AlignRight
    headings[i] = parts[2] and parts[2] ~= "" and inlines(parts[2]) or parts[1]
  end
  if #columns == 0 then fail("the table '%s' of the report has no line 'column: ...'.", spec.table) end
  local rows = {}
  for i, row in ipairs(select(loaded, spec.where or "")) do
    rows[i] = {}
    for j, column in ipairs(columns) do
      local text = field(loaded, row, column.expression, column.format)
      -- Numbers stand to the right, with gaps among them or not.
      if text ~= "" and not text:gsub("−", "-"):match("^[-+]?%d") then alignments[j] = pandoc.AlignLeft end
      rows[i][j] = column.format == "text" and {pandoc.Span({pandoc.Str(text)}, pandoc.Attr("", {"text"}))} or text
    end
  end
  local caption = inlines(spec.caption or "")
  table.insert(caption, pandoc.Space())
  table.insert(caption, spec.table:match("^published/") and data_link("data/" .. spec.table .. ".csv") or
    made_by(program_of(spec.table)))
  return simple_table(caption, headings, alignments, rows)
end

local function figure_block(block)
  local spec = settings(block, {figure = true, caption = true})
  local name = spec.figure or fail("a figure of the report has no line 'figure: ...'.")
  local program = program_of(name)
  local path = string.format("%s/%s/%s.svg", results, program, name)
  if #read(path, hint(program)) == 0 then fail("%s is empty.", path) end
  load_record(program)
  local caption = inlines(spec.caption or fail("the figure '%s' has no caption.", name))
  local text = pandoc.utils.stringify(caption)
  table.insert(caption, pandoc.Space())
  table.insert(caption, made_by(program))
  local image = pandoc.Div({pandoc.Plain {pandoc.Image({pandoc.Str(text)}, path)}}, pandoc.Attr("", {"scroll"}))
  return pandoc.Div({image, pandoc.Para(caption)}, pandoc.Attr("", {"figure"}))
end

local function manifest_block()
  local rows = {}
  for i, row in ipairs(programs()) do
    local record = load_record(row.program)
    rows[i] = {row.item, row.title, {pandoc.Code(command(row.program))}, string.format("%.1f", record.seconds)}
  end
  return simple_table({}, {"In the thesis", "Title", "Command", "Seconds"},
    {pandoc.AlignLeft, pandoc.AlignLeft, pandoc.AlignLeft, pandoc.AlignRight}, rows)
end

local function provenance_block()
  local rows, described = {}, {}
  local items = {}
  local function describe(name, value)
    local line = name .. ": " .. tostring(value)
    if not described[line] then
      described[line] = true
      items[#items + 1] = {pandoc.Plain {pandoc.Str(line)}}
    end
  end
  for i, row in ipairs(programs()) do
    local record = load_record(row.program)
    local origin = record.source or {}
    local commit = origin.commit and origin.commit:sub(1, 12) or "unknown"
    if origin.dirty then commit = commit .. ", with changes" end
    local options = {}
    for name, value in pairs(record.options or {}) do
      if name ~= "--out" and name ~= "--from" and value ~= false then
        options[#options + 1] = value == true and name or name .. " " .. option_text(value)
      end
    end
    table.sort(options)
    rows[i] = {{pandoc.Code(row.program)}, {pandoc.Code(commit)}, record.finished or "", table.concat(options, "  ")}
    describe("Compiler", string.format("%s, %s, %s", record.build.compiler, record.build.type, record.build.flags))
    for _, library in ipairs({"Eigen", "Boost", "NLopt", "Ipopt", "gnuplot"}) do
      if record.libraries[library] then
        describe(library, (record.libraries[library]:gsub("^gnuplot ", "")))
      end
    end
    describe("Processor", record.processor)
  end
  local made = simple_table({}, {"Program", "Commit", "Finished", "Options"},
    {pandoc.AlignLeft, pandoc.AlignLeft, pandoc.AlignLeft, pandoc.AlignLeft}, rows)
  return {made, pandoc.BulletList(items)}
end

local function has_class(element, class) return element.classes:includes(class) end

local drawing = {
  -- A box that scrolls around a formula wider than the screen.
  Math = function(math)
    if math.mathtype == "DisplayMath" then return pandoc.Span({math}, pandoc.Attr("", {"formula"})) end
  end,
  CodeBlock = function(block)
    if has_class(block, "table") then return table_block(block) end
    if has_class(block, "figure") then return figure_block(block) end
    if has_class(block, "manifest") then return manifest_block() end
    if has_class(block, "provenance") then return provenance_block() end
  end,
  Code = function(code)
    if has_class(code, "value") then
      local name, expression, conditions = code.text:match("^(%S+)%s+(%S+)%s*(.*)$")
      if not name then fail("'%s' does not name a table and a column.", code.text) end
      local loaded = load_table(name)
      local rows = select(loaded, conditions)
      if #rows > 1 then fail("'%s' means %d rows, but must mean one.", code.text, #rows) end
      return pandoc.Str(field(loaded, rows[1], expression, code.attributes.format))
    elseif has_class(code, "setting") then
      local program, option = code.text:match("^(%S+)%s+(%S+)$")
      if not program then fail("'%s' does not name a program and an option.", code.text) end
      local value = (load_record(program_of(program)).options or {})[option]
      if value == nil then fail("the program '%s' has no option '%s'.", program, option) end
      return pandoc.Str(option_text(value, code.attributes.format))
    end
  end,
}

return {
  {
    Meta = function(meta)
      results = pandoc.utils.stringify(meta.results or fail("the folder of the results is not given."))
      source = pandoc.utils.stringify(meta.source or fail("the folder of the sources is not given."))
    end,
  },
  drawing,
}
