-- What is shipped beside the report, and whether every link of it leads somewhere.

local support = require "support"

local links = {}
local shipped, order = {}, {}
-- The folder beside the report that holds what it links to.
local folder = "report_files/"

-- A file that is copied into the report's folder under this name, such as results/table_5_3/table_5_3.csv; returns the
-- name.
function links.ship(name, path)
  if not shipped[name] then
    shipped[name] = path
    order[#order + 1] = name
  end
  return name
end

-- Where a link to a shipped file leads.
function links.target(name) return folder .. name end

-- Writes the list of what is shipped for paper/build: the name, a tab, the path.
function links.write(path)
  table.sort(order)
  local file = io.open(path, "w")
  for _, name in ipairs(order) do file:write(folder, name, "\t", shipped[name], "\n") end
  file:close()
end

-- The explorer, which a command of its own makes: where it is, as seen from the report.
local explorer = "../explorer/index.html"

-- Every link within the document must have its place, every link to a file must lead to one that is shipped.
function links.check(document)
  local places = {}
  local function note(element)
    if element.identifier ~= "" then places[element.identifier] = true end
  end
  document:walk {Header = note, Div = note, Span = note, CodeBlock = note, Table = note}
  document:walk {
    Link = function(link)
      local target = link.target
      local place = target:match("^#(.*)$")
      if place and not places[place] then
        support.fail("the link '%s' leads to '#%s', which is not in the report.", pandoc.utils.stringify(link), place)
      end
      local elsewhere = target:match("^https?://") or target == explorer
      if not place and not elsewhere and not shipped[target:sub(#folder + 1)] then
        support.fail("the link '%s' leads to '%s', which is not shipped with the report.",
          pandoc.utils.stringify(link), target)
      end
    end,
  }
end

return links
