-- Numbers and claims within sentences.
--
--   `table_5_3_so_synthesis[workspace=P1 optimizer=dynamic_q formulation=area].f_star`{.value format="%.3f"}
--   [most of them]{.claim test="count(verify, verdict='agrees') > count(verify) / 2"}
--   [all of them]{.claim test="..." otherwise="not all of them"}
--
-- A number is an expression over tables of results; a claim is a text that may stand only where its test is true. Where
-- it is false the build fails, or the other wording stands in its place.
--
--   ``` {.define}
--   name: expression, which may go on over lines that begin with a blank
--   ```

local expressions = require "expressions"
local links = require "links"
local manifest = require "manifest"
local numbers = require "numbers"
local records = require "records"
local support = require "support"
local tables = require "tables"

local values = {}

local function one_line(text) return support.trim((text:gsub("%s+", " "))) end

function values.define(block)
  local name, source
  local function finish()
    if name then expressions.define(name, one_line(source)) end
  end
  for line in block.text:gmatch("[^\n]+") do
    local new, rest = line:match("^([%a_][%w_]*):%s*(.*)$")
    if new then
      finish()
      name, source = new, rest
    elseif name and line:match("^%s") then
      source = source .. " " .. line
    else
      support.fail("'%s' is not understood in a block of definitions.", line)
    end
  end
  finish()
end

-- A link from a number to the file it comes from, which says more to the pointer that rests on it.
local function linked(text, source)
  if support.katex then return pandoc.Str(text) end
  local name, column, conditions = expressions.origin(source)
  local file, title
  if not name then
    local kind, program, option = source:match("^(%a+)%(%s*'([^']*)'%s*,%s*'([^']*)'%s*%)$")
    if not program then return pandoc.Span({pandoc.Str(text)}, pandoc.Attr("", {"value"}, {title = source})) end
    program = manifest.program_of(program)
    local path = string.format("%s/%s/%s.json", support.results, program, program)
    file = links.ship(records.path(program), path)
    title = string.format("%s %s\nfile %s\nsource %s\ncommand %s", kind == "setting" and "option" or kind, option, file,
      manifest.source_of(program), manifest.command(program))
  else
    local loaded = tables.load(name)
    file = loaded.file
    title = tables.origin(loaded, column or expressions.spelled_out(source), expressions.fields(source), column and conditions)
  end
  return pandoc.Link({pandoc.Str(text)}, links.target(file), title, pandoc.Attr("", {"value"}))
end

function values.number(code)
  local source = one_line(code.text)
  local value = expressions.value(source)
  local format = code.attributes.format
  local text
  if type(value) == "table" then
    text = numbers.option(value, format)
  elseif type(value) == "number" and not format then
    text = numbers.format("%.12g", value)
  elseif format == "name" then
    text = pandoc.utils.stringify(numbers.name(value))
  elseif format then
    text = numbers.format(format, tonumber(value) or support.fail("'%s' is not a number.", tostring(value)))
  else
    text = tonumber(value) and numbers.format("%s", value) or tostring(value)
  end
  return linked(text, source)
end

function values.claim(span)
  local test = one_line(span.attributes.test or
    support.fail("the claim '%s' has no test.", pandoc.utils.stringify(span.content)))
  local holds, otherwise = expressions.holds(test), span.attributes.otherwise
  if not holds and not otherwise then
    support.fail("the claim '%s' is false: %s.", pandoc.utils.stringify(span.content), test)
  end
  local content = holds and span.content or support.inlines(otherwise)
  if support.katex then return content end
  local checked = "checked when the report is made:\n" .. (holds and test or "not (" .. test .. ")")
  return pandoc.Span(content, pandoc.Attr("", {"claim"}, {title = checked}))
end

values.filter = {
  Code = function(code)
    if code.classes:includes("value") then return values.number(code) end
  end,
  Span = function(span)
    if span.classes:includes("claim") then return values.claim(span) end
  end,
}

-- The numbers and claims of a caption or heading in Markdown.
function values.inlines(markdown)
  local plain = pandoc.walk_block(pandoc.Plain(support.inlines(markdown)), values.filter)
  return pandoc.Inlines(plain.content)
end

return values
