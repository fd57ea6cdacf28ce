-- Tables of the report.
--
--   ``` {.table}
--   table: table_5_3_so_synthesis
--   where: optimizer=dynamic_q formulation=area
--   column: workspace
--   column: f_star | $f^*$ | %.4f
--   column: f_star - published_f_star | difference | %+.4f
--   thesis: Table 5.3
--   caption: Markdown, with $formulas$, numbers and claims.
--   ```
--
-- A line "spread: limit | slope" puts the values of `slope` for every `limit` side
-- by side, in columns named after the limits. "order: column" sorts by a column. "media: screen" leaves the table out of
-- the printed report. Without a heading a column has its symbol or its name, without a format it is shown as it is
-- written. Other formats than those of numbers: `text` for long texts, `name` for names of programs and optimizers and
-- other things whose underscores are to be blanks, `code` for names as one types them, `symbol` for those of quantities,
-- `yes` for 0 and 1, `synthesis` for the tables of the thesis, which are to be called SO, MO and D.

local captions = require "captions"
local expressions = require "expressions"
local manifest = require "manifest"
local numbers = require "numbers"
local print = require "print"
local support = require "support"
local tables = require "tables"
local values = require "values"

local blocks = {}

local text_formats = {text = true, name = true, code = true, symbol = true, synthesis = true, yes = true}
-- Columns of such names need not say how they are to be shown.
local usual_formats = {optimizer = "name", solver = "name", inner = "name", outer = "name", status = "name",
  source = "name", formulation = "name", family = "name", kind = "name", verdict = "name", quantity = "symbol",
  limit = "name", reading = "name", parameter = "name"}

-- The text of a cell; an empty field stays empty.
local function cell_text(loaded, row, column)
  local format, value = column.format, nil
  if loaded.columns[column.expression] or column.expression:match("^[%w_]+$") then
    value = row[tables.need(loaded, column.expression)]
  else
    for _, name in ipairs(expressions.columns(column.expression, loaded)) do
      if row[name] == "" then return "" end
    end
    value = expressions.value(column.expression, loaded, row)
  end
  if value == "" then return "" end
  if format == "synthesis" then return manifest.synthesis_of(value) or value, value end
  if not format or text_formats[format] then
    return tonumber(value) and numbers.format("%s", value) or tostring(value), value
  end
  local number = tonumber(value) or
    support.fail("the table '%s', column '%s': '%s' is not a number.", loaded.name, column.expression, value)
  return numbers.format(format, number), value
end

local function cell_content(text, format)
  if text == "" then return {} end
  if format == "text" then return {pandoc.Span(support.inlines(text:gsub("[%*_%$`%^~]", "\\%0")), pandoc.Attr("", {"text"}))} end
  if format == "code" then return {pandoc.Code(text)} end
  if format == "name" then return numbers.name(text) end
  if format == "yes" then
    return {pandoc.Str(({["0"] = "no", ["1"] = "yes"})[text] or support.fail("'%s' is neither 0 nor 1.", text))}
  end
  local symbol = format == "symbol" and numbers.symbol(text)
  return {symbol and pandoc.Math("InlineMath", symbol) or pandoc.Str(text)}
end

-- Which row it is, for the pointer that rests on a number: its number in the file and its short texts.
local function place_of(loaded, row)
  local parts = {}
  for _, column in ipairs(loaded.order) do
    local text = row[column] or ""
    if #parts < 4 and text ~= "" and #text < 30 and not tonumber(text) and not text:match("[%s:]") then
      parts[#parts + 1] = column .. "=" .. text
    end
  end
  local number = loaded.numbers[row]
  return (number and number .. (#parts > 0 and ": " or "") or "") .. table.concat(parts, " ")
end

-- A table of inlines. `titles` holds a text for each cell, shown when the pointer rests on it, and `heading_titles` for
-- each heading; `sort_keys` what a cell is sorted by where that is not its text.
function blocks.layout(caption, place, headings, alignments, rows, titles, heading_titles, sort_keys)
  local function cells(contents)
    local row = {}
    for i, content in ipairs(contents) do row[i] = {pandoc.Plain(content)} end
    return row
  end
  local body, widths = {}, {}
  for i = 1, #headings do widths[i] = 0 end
  for i, row in ipairs(rows) do body[i] = cells(row) end
  local made = pandoc.utils.from_simple_table(pandoc.SimpleTable({}, alignments, widths, cells(headings), body))
  local classes, attributes = {"wide"}, {}
  if support.katex then
    print.group_rows(made)
    attributes.style = print.table_style(headings, rows, pandoc.utils.stringify(caption))
    if #rows <= print.whole_table then classes[2] = "whole" end
  else
    for j, title in ipairs(heading_titles or {}) do
      made.head.rows[1].cells[j].attr = pandoc.Attr("", {}, {{"title", title}})
    end
    for i, row in ipairs(made.bodies[1].body) do
      for j, cell in ipairs(row.cells) do
        local title, key = titles and titles[i][j], sort_keys and sort_keys[i][j]
        local set = {}
        if title then set[1] = {"title", title} end
        if key then set[#set + 1] = {"v", key} end
        if #set > 0 then cell.attr = pandoc.Attr("", {}, set) end
      end
    end
  end
  local box = pandoc.Div({made}, pandoc.Attr("", {"scroll"}, attributes))
  local content = {pandoc.Para(caption), box}
  if not support.katex and #rows > 30 then
    content = {pandoc.RawBlock("html", "<details><summary>"), pandoc.Plain(caption),
      pandoc.RawBlock("html", "</summary>"), box, pandoc.RawBlock("html", "</details>")}
  end
  return pandoc.Div(content, pandoc.Attr(place, classes))
end

function blocks.draw(block)
  local spec = support.settings(block, {table = true, where = true, spread = true, order = true,
    media = true, id = true, column = true, thesis = true, caption = true})
  local loaded = tables.load(spec.table or support.fail("a table of the report has no line 'table: ...'."))
  local caption, place = captions.make("Table", spec, spec.table, {loaded.file}, loaded.program)
  local headings, alignments, columns = {}, {}, {}
  for i, text in ipairs(spec.column) do
    local parts = support.fields(text)
    local expression = parts[1]
    columns[i] = {expression = expression, format = parts[3] ~= "" and parts[3] or usual_formats[expression]}
    alignments[i] = pandoc.AlignRight
    local symbol = numbers.symbol(expression)
    if parts[2] and parts[2] ~= "" then
      headings[i] = values.inlines(parts[2])
    else
      headings[i] = symbol and {pandoc.Math("InlineMath", symbol)} or {pandoc.Str((expression:gsub("_", " ")))}
    end
  end
  if #columns == 0 then support.fail("the table '%s' of the report has no line 'column: ...'.", spec.table) end
  local selected = expressions.select(loaded, spec.where or "")
  if #selected == 0 then support.fail("the table '%s' has no row with %s.", spec.table, spec.where or "") end
  if spec.spread then
    local parts, keep = support.fields(spec.spread), {}
    for _, column in ipairs(columns) do
      if loaded.columns[column.expression] then keep[#keep + 1] = column.expression end
    end
    loaded = tables.spread(loaded, selected, keep, parts[1], parts[2])
    selected = loaded.rows
  end
  if spec.order then
    table.sort(selected, function(one, other) return tonumber(one[spec.order]) < tonumber(other[spec.order]) end)
  end
  local fields, heading_titles = {}, {}
  for j, column in ipairs(columns) do
    local source = column.expression
    fields[j] = loaded.columns[source] and {{loaded, source}} or expressions.fields(source, loaded)
    heading_titles[j] = tables.origin_of_column(source, fields[j])
  end
  local rows, titles, sort_keys = {}, {}, {}
  for i, row in ipairs(selected) do
    rows[i], titles[i], sort_keys[i] = {}, {}, {}
    local which = place_of(loaded, row)
    for j, column in ipairs(columns) do
      local text, value = cell_text(loaded, row, column)
      -- Numbers stand to the right, with gaps among them or not.
      local number = column.format ~= "yes" and text:gsub("−", "-"):match("^[-+]?%d")
      if text ~= "" and not number then alignments[j] = pandoc.AlignLeft end
      rows[i][j] = cell_content(text, column.format)
      titles[i][j] = tables.origin_of_cell(loaded, column.expression, fields[j], which)
      sort_keys[i][j] = tonumber(value) and tostring(value)
    end
  end
  if spec.media == "screen" and support.katex then return {} end
  return blocks.layout(caption, place, headings, alignments, rows, titles, heading_titles, sort_keys)
end

return blocks
