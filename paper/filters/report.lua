-- The report's filter: draws tables, figures, numbers and claims from the results into the pages. What is not there, and
-- what is not true, fails the build. Each part is in a file of its own beside this one:
--
--   values         numbers and claims in sentences         expressions   what they are made of
--   table_blocks   tables                                  tables        tables of results
--   figures        figures                                 pictures      gnuplot's SVG for the page
--   provenance     where results come from                 records       what programs record about their runs
--   captions       numbered captions and links to them     links         what is shipped; links that lead nowhere
--   print          what only the printed report needs      numbers       numbers and names as people write them

package.path = PANDOC_SCRIPT_FILE:gsub("[^/]*$", "") .. "?.lua"

local support = require "support"
local captions = require "captions"
local figures = require "figures"
local links = require "links"
local print = require "print"
local provenance = require "provenance"
local table_blocks = require "table_blocks"
local values = require "values"

local drawing = {
  CodeBlock = function(block)
    local has = function(class) return block.classes:includes(class) end
    if has("table") then return table_blocks.draw(block) end
    if has("figure") then return figures.draw(block) end
    if has("manifest") then return provenance.manifest(block) end
    if has("provenance") then return provenance.draw(block) end
  end,
  Code = values.filter.Code,
  Span = values.filter.Span,
}

-- No line begins with the comma or full stop behind a formula.
local keep_together = {
  Inlines = function(inlines)
    local kept = pandoc.Inlines {}
    for _, inline in ipairs(inlines) do
      local before = kept[#kept]
      local behind = before and before.t == "Math" and before.mathtype == "InlineMath" and inline.t == "Str"
      if behind and inline.text:match("^[.,:;)]") then
        kept[#kept] = pandoc.Span({before, inline}, pandoc.Attr("", {"unbroken"}))
      else
        kept:insert(inline)
      end
    end
    return kept
  end,
}

-- On the screen: a box that scrolls around a formula wider than it.
local on_screen = {
  Math = function(math)
    if math.mathtype == "DisplayMath" then return pandoc.Span({math}, pandoc.Attr("", {"formula"})) end
  end,
}

local function draw(document)
  local meta = document.meta
  local function given(name, what)
    return pandoc.utils.stringify(meta[name] or support.fail("the %s is not given.", what))
  end
  support.results = given("results", "folder of the results")
  support.source = given("source", "folder of the sources")
  support.listing = given("listing", "list of the experiments' files")
  support.katex = meta.katex and pandoc.utils.stringify(meta.katex)
  support.pictures = meta.pictures and pandoc.utils.stringify(meta.pictures)
  meta.date = provenance.made_when()

  -- paper/build puts a mark before each page.
  local blocks = pandoc.Blocks {}
  local function page_of(block)
    return block.t == "CodeBlock" and block.classes:includes("page") and block.attributes.name
  end
  for _, block in ipairs(document.blocks) do
    if page_of(block) then support.page = page_of(block) end
    if block.t == "CodeBlock" and block.classes:includes("define") then values.define(block) end
  end
  for _, block in ipairs(document.blocks) do
    if page_of(block) then
      support.page = page_of(block)
    elseif not (block.t == "CodeBlock" and block.classes:includes("define")) then
      blocks:extend(pandoc.walk_block(pandoc.Div({block}), drawing).content)
    end
  end
  support.page = nil
  document.blocks = blocks
  document = captions.name_links(document)
  links.check(document)
  if meta.shipped then links.write(pandoc.utils.stringify(meta.shipped)) end
  if meta.legends then figures.write_legends(pandoc.utils.stringify(meta.legends)) end
  document = document:walk(keep_together)
  return support.katex and print.set_formulas(print.name_sections(document)) or document:walk(on_screen)
end

return {{Pandoc = draw}}
