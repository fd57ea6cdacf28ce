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
-- made of these fields, such as a time. Without a heading a column has its own name, without a format it is shown as it
-- is written. Other formats than those of numbers: `text` for long texts, `words` for names whose underscores are to be
-- blanks, `code` for names of programs and optimizers, `symbol` for names of quantities, `yes` for 0 and 1.
-- A table is <program>, <program>_<part>, or published/table_5_3 for the printed numbers.
--
-- A figure:                 ``` {.figure}
--                           figure: figure_5_7_so_synthesis
--                           caption: ...
--                           ```
-- The manifest:             ``` {.manifest}
-- Where results come from:  ``` {.provenance}

local results, source
-- The folder of KaTeX when the report is to be printed; nothing when it is for the screen.
local katex

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
  for line in pandoc.pipe(source .. "/scripts/manifest", {"rows"}, ""):gmatch("[^\n]+") do
    local program, item, title = line:match("^(.-)|(.-)|(.-)|")
    manifest[#manifest + 1] = {program = program, item = item, title = title}
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

-- Names of quantities in the results, as the thesis writes them.
local symbols = {N_g = "N^g", N_f = "N^f", f_d0 = "f(\\mathbf{d}^0)", f_star = "f^*", ["f*"] = "f^*", g_star = "g^*",
  ["g*"] = "g^*"}

local raised = {["-"] = "⁻", ["0"] = "⁰", ["1"] = "¹", ["2"] = "²", ["3"] = "³", ["4"] = "⁴", ["5"] = "⁵", ["6"] = "⁶",
  ["7"] = "⁷", ["8"] = "⁸", ["9"] = "⁹"}

-- A number as people write it: a true minus sign, and powers of ten in place of an exponent, except for zero.
local function format_number(format, number)
  if number == 0 and format:match("e$") then return "0" end
  local text = string.format(format, number)
  local mantissa, exponent = text:match("^(.-)[eE]([+-]%d+)$")
  if mantissa then
    text = mantissa .. "\u{a0}×\u{a0}10" .. tostring(math.tointeger(tonumber(exponent))):gsub(".", raised)
  end
  return (text:gsub("%-", "−"))
end

local text_formats = {text = true, words = true, code = true, symbol = true, yes = true}
-- Columns of such names need not say how they are to be shown.
local usual_formats = {optimizer = "code", solver = "code", inner = "code", outer = "code", status = "words",
  quantity = "symbol"}

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
  if format == nil or format == "" or text_formats[format] then
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

-- What fits on a printed page, in points: a table across it, in type of at most this size; a table that needs smaller
-- type than the least, on a page of its own that is turned. A letter is about half as wide as the type, a column has a
-- gap, and texts may be broken into lines of so many letters. A picture has so many points per pixel.
local print_page = {upright = 470, turned = 710, largest = 9, least = 7, letter = 0.52, gap = 0.85, line = 20,
  turned_line = 42, picture = 0.56, broad_picture = 533}

-- The letters of a cell that must stand on one line when long texts have lines of `line` letters. Of a formula, about
-- those that are seen.
local function letters(cell, line)
  if type(cell) == "string" then
    local longest = 0
    for word in cell:gmatch("[^ ]+") do longest = math.max(longest, utf8.len(word)) end
    return math.max(longest, math.min(utf8.len(cell), print_page.line))
  end
  local text = pandoc.utils.stringify(cell)
  if cell[1].t == "Code" then return utf8.len(text) end
  if cell[1].t == "Span" then return math.min(utf8.len(text), line) end
  return utf8.len((text:gsub("\\%a+", "x"):gsub("[{}^_\\,;]", "")))
end

-- The letters of the longest word of a heading.
local function heading_letters(heading)
  local longest = 0
  for _, part in ipairs(type(heading) == "string" and {pandoc.Str(heading)} or heading) do
    longest = math.max(longest, letters({part}))
  end
  return longest
end

-- The class and the style of a printed table.
local function printed_table(headings, rows)
  local function largest(room, line)
    local width = 0
    for j, heading in ipairs(headings) do
      local most = heading_letters(heading)
      for _, row in ipairs(rows) do most = math.max(most, letters(row[j], line)) end
      width = width + print_page.letter * most + print_page.gap
    end
    return math.min(room / width, #rows > 30 and print_page.least + 0.5 or print_page.largest)
  end
  local class, size = "upright", largest(print_page.upright, print_page.line)
  if size < print_page.least then class, size = "turned", largest(print_page.turned, print_page.turned_line) end
  return class, string.format("font-size: %.1fpt", size)
end

-- The class and the style of a printed picture: in one scale as far as the page allows it.
local function printed_picture(pixels)
  local width = pixels * print_page.picture
  local class = width > 1.45 * print_page.upright and "turned" or width > print_page.upright and "broad" or "upright"
  local room = print_page[class == "broad" and "broad_picture" or class]
  return class, string.format("width: %.0fpt", math.min(width, room))
end

-- The caption stands above the part that scrolls on a narrow screen. A long table scrolls under its head on any screen;
-- in print it goes over several pages.
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
  local attributes = pandoc.Attr("", {"scroll"})
  local classes = {"wide", #rows > 30 and "long" or #rows > 12 and "medium" or "short"}
  if katex then
    local class, style = printed_table(headings, rows)
    classes[3], attributes = class, pandoc.Attr("", {}, {style = style})
  end
  local box = pandoc.Div({pandoc.utils.from_simple_table(made)}, attributes)
  return pandoc.Div(#caption > 0 and {pandoc.Para(caption), box} or {box}, pandoc.Attr("", classes))
end

local function data_link(name)
  return pandoc.Span({pandoc.Str("Data: "), pandoc.Code(name)}, pandoc.Attr("", {"made"}))
end

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

local function as_cell(text, format)
  if format == "text" then return {pandoc.Span({pandoc.Str(text)}, pandoc.Attr("", {"text"}))} end
  if format == "code" and text ~= "" then return {pandoc.Code(text)} end
  if format == "words" then return (text:gsub("_", " ")) end
  if format == "yes" then return ({["0"] = "no", ["1"] = "yes"})[text] or fail("'%s' is neither 0 nor 1.", text) end
  local symbol = format == "symbol" and (symbols[text] or text:match("^%a[_^][%a*]$"))
  return symbol and {pandoc.Math("InlineMath", symbol)} or text
end

local function table_block(block)
  local spec = settings(block, {table = true, where = true, measured = true, column = true, caption = true})
  local loaded = load_table(spec.table or fail("a table of the report has no line 'table: ...'."))
  if spec.measured then loaded = with_measured(loaded, spec.measured) end
  local headings, alignments, columns = {}, {}, {}
  for i, text in ipairs(spec.column) do
    local parts = {}
    for part in (text .. "|"):gmatch("(.-)|") do parts[#parts + 1] = trim(part) end
    columns[i] = {expression = parts[1], format = parts[3] or usual_formats[parts[1]]}
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
      local number = column.format ~= "yes" and text:gsub("−", "-"):match("^[-+]?%d")
      if text ~= "" and not number then alignments[j] = pandoc.AlignLeft end
      rows[i][j] = as_cell(text, column.format)
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
  local picture = read(path, hint(program))
  if #picture == 0 then fail("%s is empty.", path) end
  load_record(program)
  local caption = inlines(spec.caption or fail("the figure '%s' has no caption.", name))
  local text = pandoc.utils.stringify(caption)
  table.insert(caption, pandoc.Space())
  table.insert(caption, made_by(program))
  local pixels = tonumber(picture:match('<svg[^>]*width="(%d+)"')) or fail("%s has no width.", path)
  local classes, attributes = {"figure"}, {style = "--pixels: " .. pixels}
  if katex then
    -- WeasyPrint does not draw all that gnuplot writes as svg.
    classes[2], attributes.style = printed_picture(pixels)
    path = path:gsub("svg$", "png")
    read(path, hint(program))
  end
  local image = pandoc.Image({pandoc.Str(text)}, path, "", pandoc.Attr("", {}, attributes))
  image = pandoc.Div({pandoc.Plain {image}}, pandoc.Attr("", {"scroll"}))
  return pandoc.Div({image, pandoc.Para(caption)}, pandoc.Attr("", classes))
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

-- The commit a result was made from.
local function commit_of(record)
  local origin = record.source or {}
  return (origin.commit and origin.commit:sub(1, 12) or "unknown") .. (origin.dirty and ", with changes" or "")
end

-- For the title: the day of the last result, and the commit if it is that of all.
local function made_when()
  local latest, commit, several = "", nil, false
  for _, row in ipairs(programs()) do
    local record = load_record(row.program)
    if (record.finished or "") > latest then latest = record.finished end
    commit = commit or commit_of(record)
    several = several or commit ~= commit_of(record)
  end
  return pandoc.Inlines {pandoc.Str("Results of " .. latest:sub(1, 10) .. ", " ..
    (several and "from several commits, listed at the end" or "commit " .. (commit or "unknown")))}
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
    local options = {}
    for name, value in pairs(record.options or {}) do
      if name ~= "--out" and name ~= "--from" and value ~= false then
        options[#options + 1] = value == true and name or name .. " " .. option_text(value)
      end
    end
    table.sort(options)
    rows[i] = {{pandoc.Code(row.program)}, {pandoc.Code(commit_of(record))}, record.finished or "",
      as_cell(table.concat(options, "  "), "text")}
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

-- Formulas -----------------------------------------------------------------------------------------------------------

local function mark(math) return (math.mathtype == "DisplayMath" and "D " or "I ") .. math.text:gsub("%s+", " ") end

-- On the screen: a box that scrolls around a formula wider than it.
local on_screen = {
  Math = function(math)
    if math.mathtype == "DisplayMath" then return pandoc.Span({math}, pandoc.Attr("", {"formula"})) end
  end,
}

-- In print: raised digits as digits that are raised, for the font has no others.
local lowered = {}
for digit, sign in pairs(raised) do lowered[sign] = digit == "-" and "−" or digit end

local function set_raised(str)
  local parts = {}
  local function add(text, is_raised)
    if text ~= "" then parts[#parts + 1] = is_raised and pandoc.Superscript {pandoc.Str(text)} or pandoc.Str(text) end
  end
  local run, is_raised = "", false
  for sign in str.text:gmatch(utf8.charpattern) do
    local digit = lowered[sign]
    if is_raised ~= (digit ~= nil) then
      add(run, is_raised)
      run, is_raised = "", not is_raised
    end
    run = run .. (digit or sign)
  end
  add(run, is_raised)
  return parts
end

-- In print: what stands on a turned page takes its heading along, and the text after it goes on upright.
local function turn_headings(document)
  local blocks = document.blocks
  local function turned(block) return block and block.classes and block.classes:includes("turned") end
  for i = #blocks - 1, 1, -1 do
    if blocks[i].t == "Header" and turned(blocks[i + 1]) then blocks[i].classes:insert("turned") end
  end
  for i, block in ipairs(blocks) do
    if turned(block) and not turned(blocks[i + 1]) then block.classes:insert("last") end
  end
  document.blocks = blocks
  return document
end

-- In print: every formula as KaTeX sets it, all of them at once.
local function set_formulas(document)
  local lines, known = {}, {}
  document:walk {Math = function(math)
    local line = mark(math)
    if not known[line] then
      known[line] = true
      lines[#lines + 1] = line
    end
  end}
  local script = pandoc.path.join({pandoc.path.directory(PANDOC_SCRIPT_FILE), "formulas.js"})
  local done, html = pcall(pandoc.pipe, "node", {script, katex}, table.concat(lines, "\n") .. "\n")
  if not done then os.exit(1) end
  local set, i = {}, 0
  for line in html:gmatch("[^\n]+") do
    i = i + 1
    set[lines[i]] = line
  end
  return document:walk {
    Math = function(math) return pandoc.RawInline("html", set[mark(math)]) end,
    Str = set_raised,
  }
end

return {
  {
    Meta = function(meta)
      results = pandoc.utils.stringify(meta.results or fail("the folder of the results is not given."))
      source = pandoc.utils.stringify(meta.source or fail("the folder of the sources is not given."))
      katex = meta.katex and pandoc.utils.stringify(meta.katex)
      meta.date = made_when()
      return meta
    end,
  },
  drawing,
  {Pandoc = function(document) return katex and set_formulas(turn_headings(document)) or document:walk(on_screen) end},
}
