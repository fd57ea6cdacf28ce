-- What only the printed report needs: sizes that fit its pages, rows that stay together, formulas set by KaTeX.

local numbers = require "numbers"
local support = require "support"

local print = {
  -- A table of at most so many rows stands on one page; of a longer one so many rows stay together at both ends.
  whole_table = 9, kept_rows = 4,
}

-- What fits on a printed page, in points: a table across it, a picture that reaches into its margins; a table in type of at most and at least this size. A letter is about
-- half as wide as the type, a column has a gap, and texts may be broken into lines of so many letters. A picture has so
-- many points per pixel, and its type, of so many pixels, must not become smaller than the least type.
local page = {width = 470, broad = 533, largest = 9, least = 7, letter = 0.52, gap = 0.85, line = 26, picture = 0.56,
  type = 13}

-- The letters of a cell that must stand on one line. Of a formula, about those that are seen.
local function letters(content)
  local text = pandoc.utils.stringify(content)
  local first = content[1]
  if first and first.t == "Code" then return utf8.len(text) end
  if first and first.t == "Span" and first.classes:includes("text") then
    return math.min(utf8.len(text), page.line)
  end
  local seen = text:gsub("\\mathbf", ""):gsub("\\text", ""):gsub("\\%a+", "x"):gsub("[{}^_\\,;]", "")
  local longest = 0
  for word in seen:gmatch("[^ ]+") do longest = math.max(longest, utf8.len(word)) end
  return math.max(longest, math.min(utf8.len(seen), 16))
end

-- The letters of the longest word of a heading.
local function heading_letters(heading)
  local longest = 0
  for _, part in ipairs(heading) do longest = math.max(longest, part.t == "Space" and 0 or letters({part})) end
  return longest
end

function print.table_style(headings, rows, caption)
  local width = 0
  for j, heading in ipairs(headings) do
    local most = heading_letters(heading)
    for _, row in ipairs(rows) do most = math.max(most, letters(row[j])) end
    width = width + page.letter * most + page.gap
  end
  local size = math.min(page.width / width, #rows > 30 and page.least + 0.5 or page.largest)
  if size < page.least then
    support.fail("'%.40s...' is too wide for a printed page: its type would be of %.1f points.", caption, size)
  end
  return string.format("font-size: %.1fpt", size)
end

-- Rows at both ends of a table that stay together, each group as a body of its own.
function print.group_rows(made)
  local rows, kept = made.bodies[1].body, print.kept_rows
  if #rows <= 2 * kept then return end
  local bodies = {}
  local function add(first, last, class)
    if first > last then return end
    bodies[#bodies + 1] = {attr = pandoc.Attr("", {class}), body = table.move(rows, first, last, 1, {}), head = {},
      row_head_columns = 0}
  end
  add(1, kept, "together")
  add(kept + 1, #rows - kept, "loose")
  add(#rows - kept + 1, #rows, "together")
  made.bodies = bodies
end

-- In one scale as far as the page allows it; a broad picture reaches into the margins.
function print.picture_style(pixels, name)
  local width = math.min(pixels * page.picture, page.broad)
  local size = page.type * width / pixels
  if size < page.least then
    support.fail("the figure '%s' is too wide for a printed page: its type would be of %.1f points.", name, size)
  end
  local beyond = math.max(0, (width - page.width) / 2)
  return string.format("width: %.0fpt; margin: 0 %s", width, beyond > 0 and string.format("-%.0fpt", beyond) or "auto")
end

-- The picture as a file for WeasyPrint, which is slow with pictures that stand in the page.
function print.write_picture(name, svg)
  local path = support.pictures .. "/" .. name .. ".svg"
  local file = io.open(path, "w") or support.fail("%s cannot be written.", path)
  file:write(svg)
  file:close()
  return path
end

-- A link to a section says which one it is. (Its page would have to be laid out again when that number is known.)
function print.name_sections(document)
  local sections, counts = {}, {}
  for _, block in ipairs(document.blocks) do
    if block.t == "Header" and not block.classes:includes("unnumbered") then
      counts[block.level] = (counts[block.level] or 0) + 1
      for level = block.level + 1, #counts do counts[level] = nil end
      sections[block.identifier] = table.concat(counts, ".")
    end
  end
  return document:walk {
    Link = function(link)
      local section = sections[link.target:match("^#(.*)$")]
      if not section then return nil end
      link.content:extend {pandoc.Str("\u{a0}[§\u{a0}" .. section .. "]")}
      return link
    end,
  }
end

local function mark(math) return (math.mathtype == "DisplayMath" and "D " or "I ") .. math.text:gsub("%s+", " ") end

-- Raised digits as digits that are raised, for the font has no others.
local function set_raised(str)
  local parts = {}
  local function add(text, is_raised)
    if text ~= "" then parts[#parts + 1] = is_raised and pandoc.Superscript {pandoc.Str(text)} or pandoc.Str(text) end
  end
  local run, is_raised = "", false
  for sign in str.text:gmatch(utf8.charpattern) do
    local digit = numbers.lowered[sign]
    if is_raised ~= (digit ~= nil) then
      add(run, is_raised)
      run, is_raised = "", not is_raised
    end
    run = run .. (digit or sign)
  end
  add(run, is_raised)
  return parts
end

local greek = {alpha = "α", beta = "β", Gamma = "Γ", varepsilon = "ε", kappa = "κ", lambda = "λ", mu = "μ", rho = "ρ",
  phi = "ϕ", psi = "ψ", omega = "ω"}

-- A letter as KaTeX would set it, or nothing where there is more than a letter.
local function letter(text)
  if text:match("^%a$") then return "<i>" .. text .. "</i>" end
  if greek[text:match("^\\(%a+)$")] then return "<i>" .. greek[text:match("^\\(%a+)$")] .. "</i>" end
  local bold = text:match("^\\mathbf{(%a)}$")
  return bold and "<b>" .. bold .. "</b>"
end

-- What stands above or below a letter: a letter, a number, a star, or a word such as min.
local function script(text)
  text = text:match("^{(.*)}$") or text
  if text:match("^%-?%d+$") or text == "*" then return (text:gsub("%-", "−"):gsub("%*", "∗")) end
  return letter(text) or text:match("^\\(min)$") or text:match("^\\(max)$") or text:match("^\\text{(%a+)}$")
end

-- A letter with at most one index or exponent needs no KaTeX. WeasyPrint takes long over the tables that KaTeX makes of
-- an exponent, and most formulas of the report are so short.
local function short_formula(text)
  local alone = letter(text)
  if alone then return alone end
  local base, sign, index = text:match("^(.-)([_^])(%S+)$")
  local first, second = base and letter(base), index and script(index)
  if not (first and second) then return nil end
  local tag = sign == "^" and "sup" or "sub"
  return string.format("%s<%s>%s</%s>", first, tag, second, tag)
end

-- Every other formula as KaTeX sets it, all of them at once.
function print.set_formulas(document)
  local lines, known, set, i = {}, {}, {}, 0
  document:walk {Math = function(math)
    local line = mark(math)
    local short = math.mathtype == "InlineMath" and short_formula(math.text)
    if short then
      set[line] = '<span class="formula">' .. short .. "</span>"
    elseif not known[line] then
      known[line] = true
      lines[#lines + 1] = line
    end
  end}
  if #lines > 0 then
    local script = pandoc.path.join({support.source, "paper", "formulas.js"})
    local done, html = pcall(pandoc.pipe, "node", {script, support.katex}, table.concat(lines, "\n") .. "\n")
    if not done then os.exit(1) end
    for line in html:gmatch("[^\n]+") do
      i = i + 1
      set[lines[i]] = line
    end
  end
  return document:walk {
    Math = function(math) return pandoc.RawInline("html", set[mark(math)]) end,
    Str = set_raised,
  }
end

return print
