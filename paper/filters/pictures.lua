-- Pictures as gnuplot writes them in SVG, made ready for a page: every colour stands where it is used, points are drawn
-- in place of references to a definition, names are those of the picture, and on the screen colours follow the theme.

local support = require "support"

local pictures = {}

-- The colours of the house, to which style.css gives a variant for dark pages.
local house = {["0072b2"] = "blue", ["d55e00"] = "vermilion", ["009e73"] = "green", ["cc79a7"] = "purple",
  ["e69f00"] = "orange", ["56b4e9"] = "sky"}
local named = {black = "000000", white = "ffffff", gray = "808080", grey = "808080", lightgrey = "d3d3d3",
  dark_grey = "a0a0a0", red = "ff0000"}

-- A colour as six hexadecimal digits; nothing for `none` and the like.
local function digits(colour)
  local red, green, blue = colour:match("^rgb%(%s*(%d+),%s*(%d+),%s*(%d+)%s*%)$")
  if red then return string.format("%02x%02x%02x", tonumber(red), tonumber(green), tonumber(blue)) end
  local hexadecimal = colour:match("^#(%x%x%x%x%x%x)$")
  return hexadecimal and hexadecimal:lower() or named[colour]
end

-- A colour for the page at hand. Greys go from the colour of the page to that of its text.
local function painted(colour)
  local code = digits(colour)
  if not code or support.katex then return code and "#" .. code or colour end
  if house[code] then return "var(--" .. house[code] .. ")" end
  local red, green, blue = code:match("(%x%x)(%x%x)(%x%x)")
  red, green, blue = tonumber(red, 16), tonumber(green, 16), tonumber(blue, 16)
  local lightest, darkest = math.max(red, green, blue), math.min(red, green, blue)
  -- What is nearly black is drawn as black and grey are, whatever its hue.
  if lightest == darkest or lightest < 80 then
    if red == 255 then return "var(--page)" end
    if red == 0 then return "var(--text)" end
    return string.format("color-mix(in srgb, var(--text) %.0f%%, var(--page))", (255 - (lightest + darkest) / 2) / 2.55)
  end
  return string.format("color-mix(in srgb, #%s var(--tint), var(--page))", code)
end

local function attribute(tag, name)
  local _, value = tag:match("%s" .. name .. " ?= ?(['\"])(.-)%1")
  return value
end

-- The tags and texts of a picture in turn.
local function pieces(svg)
  return svg:gmatch("([^<]*)(<[^>]*>)")
end

-- What gnuplot calls its points: the name of a shape, whether it is filled, and what turns it.
local function read_points(svg)
  local points = {}
  for tag in svg:match("<defs>(.-)</defs>"):gmatch("<[^/][^>]*>") do
    local name = attribute(tag, "id")
    if name and name:match("^gp") then
      local base = points[(attribute(tag, "xlink:href") or ""):sub(2)]
      local filled = attribute(tag, "fill") == "currentColor"
      if base then
        points[name] = {shape = base.shape, filled = filled or base.filled, hollow = not filled,
          turn = attribute(tag, "transform") or base.turn, bare = attribute(tag, "stroke") == "none"}
      else
        local shape = tag:match("^<(%a+ .-)%s*/>$"):gsub("%s*id='[^']*'", ""):gsub("%s*stroke='[^']*'", "")
        points[name] = {shape = shape:gsub("%s*fill='[^']*'", ""), filled = filled or name == "gpDot"}
      end
    end
  end
  return points
end

-- A point of a colour at its place.
local function point(definition, transform, colour)
  local turn = definition.turn and " " .. definition.turn or ""
  return string.format('<g transform="%s%s"><%s stroke="%s" fill="%s"/></g>', transform, turn, definition.shape,
    definition.bare and "none" or painted(colour), definition.filled and painted(colour) or "none")
end

-- The picture for the page. `title` is what a screen reader says of it.
function pictures.prepare(svg, path, title)
  local width, height = svg:match('<svg[^>]*width="(%d+)" height="(%d+)"')
  if not width then support.fail("%s has no width.", path) end
  local points = svg:match("<defs>") and read_points(svg) or {}
  local body = svg:match("<svg[^>]*>(.*)$"):gsub("<defs>.-</defs>", ""):gsub("<title>.-</title>", "")
    :gsub("<desc>.-</desc>", "")
  -- Without a ground of its own, so that the page shows through.
  body = body:gsub(string.format('<rect x="0" y="0" width="%s" height="%s" fill="#ffffff"/>', width, height), "", 1)
  local parts, colours = {}, {"#000000"}
  for text, tag in pieces(body) do
    parts[#parts + 1] = text:match("%S") and text or ""
    if tag:match("^<g[%s>]") then
      colours[#colours + 1] = attribute(tag, "color") or colours[#colours]
    elseif tag == "</g>" then
      colours[#colours] = nil
    end
    local colour = colours[#colours] or "#000000"
    local use = tag:match("^<use ") and points[attribute(tag, "xlink:href"):sub(2)]
    if use then
      local place = attribute(tag, "transform") or
        string.format("translate(%s,%s)", attribute(tag, "x"), attribute(tag, "y"))
      parts[#parts + 1] = point(use, place, attribute(tag, "color") or colour)
    else
      tag = tag:gsub('%sid="[^"]*"', ""):gsub('%scolor="[^"]*"', ""):gsub("%s+", " ")
        -- A label in a box: its text with a broad rim in the colour of the page, under the text itself.
        :gsub('stroke="none"( .-) style=.filter:url%(#textbox%).', 'stroke="#ffffff" stroke-width="4"%1')
        :gsub("style=.filter:url%(#%a+%).", "")
      for _, name in ipairs {"fill", "stroke"} do
        tag = tag:gsub("%s" .. name .. " ?= ?(['\"])(.-)%1", function(quote, value)
          return " " .. name .. "=" .. quote .. painted(value == "currentColor" and colour or value) .. quote
        end)
      end
      -- A tenth of a pixel is fine enough for what is drawn; what is written keeps its digits.
      parts[#parts + 1] = tag:gsub("(%d%.%d)%d+", "%1")
    end
  end
  local drawn, empty = table.concat(parts), nil
  repeat
    drawn, empty = drawn:gsub("<g[^>]*></g>", "")
  until empty == 0
  local said = title:gsub("&", "&amp;"):gsub("<", "&lt;"):gsub('"', "&quot;")
  return string.format('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %s %s" role="img" aria-label="%s">%s',
    width, height, said, drawn), tonumber(width), tonumber(height)
end

-- The plots of a picture by panel: each has its number, the colours it draws in and whether it has a text. gnuplot calls
-- the plots of the first panel 1a, 2a, and so on, those of a picture without panels 1, 2.
local function read_plots(svg)
  local panels, at, letter = {}, 1, nil
  while true do
    local first, last, of_panel = svg:find('<g id="gnuplot_plot_%d+(%a*)"', at)
    if not first then return panels end
    local depth, stop = 0, #svg
    for position, tag in svg:sub(first):gmatch("()(</?g[ >])") do
      depth = depth + (tag:sub(2, 2) == "/" and -1 or 1)
      if depth == 0 then
        stop = first + position - 1
        break
      end
    end
    local plot = {colours = {}, named = svg:find("<text>", last, true)}
    plot.named = plot.named and plot.named < stop
    local x, y, side = svg:sub(last, stop):match('translate%(([%d.]+),([%d.]+)%)"[^>]*text%-anchor="(%a+)"[^>]*>%s*<text>')
    if plot.named and x then plot.entry = {x = tonumber(x), y = tonumber(y), side = side} end
    for name, tag in svg:sub(last, stop):gmatch("<(%a+)([^>]*)>") do
      if name == "path" or name == "polygon" or name == "use" then
        for _, key in ipairs {"color", "stroke", "fill"} do
          local code = digits(attribute(tag, key) or "")
          if code and code ~= "ffffff" then plot.colours[code] = true end
        end
      end
    end
    if of_panel ~= letter then
      letter = of_panel
      panels[#panels + 1] = {}
    end
    table.insert(panels[#panels], plot)
    at = stop
  end
end

-- Every curve, area and mark must be named: its colour belongs to a plot that has an entry in the legend of its panel, or
-- in that of another panel where its own has no legend at all or the panels share theirs. gnuplot leaves out, without a word, the entries for which
-- a legend has no room.
function pictures.check_legend(svg, path, shared)
  local panels = read_plots(svg)
  local anywhere, named_in = {}, {}
  for i, panel in ipairs(panels) do
    for _, plot in ipairs(panel) do
      for colour in pairs(plot.named and next(plot.colours) and plot.colours or {}) do
        anywhere[colour], named_in[i] = true, named_in[i] or {}
        named_in[i][colour] = true
      end
    end
  end
  for i, panel in ipairs(panels) do
    for _, plot in ipairs(panel) do
      for colour in pairs(plot.colours) do
        if not (not shared and named_in[i] or anywhere)[colour] then
          support.fail("the legend of %s does not name what panel %d draws in #%s.", path, i, colour)
        end
      end
    end
  end
end

-- Where the samples of each legend stand, a little more than that, and their colours, as lines for check_legends.py: the
-- PNG has other widths of letters, so its legend has other rows and columns.
function pictures.legends(svg, png)
  local lines = {}
  for _, panel in ipairs(read_plots(svg)) do
    local left, top, right, bottom = math.huge, math.huge, -math.huge, -math.huge
    local colours = {}
    for _, plot in ipairs(panel) do
      local entry = plot.entry
      -- A text in the middle of its place is a label in the picture.
      if entry and entry.side ~= "middle" then
        local sample = entry.side == "start" and entry.x - 24 or entry.x + 24
        left, right = math.min(left, sample - 24), math.max(right, sample + 24)
        top, bottom = math.min(top, entry.y - 14), math.max(bottom, entry.y + 6)
        for colour in pairs(plot.colours) do colours[#colours + 1] = colour end
      end
    end
    if #colours > 0 then
      local wider, higher = 12 + (right - left) / 4, 8 + (bottom - top) / 4
      table.sort(colours)
      lines[#lines + 1] = string.format("%s\t%.0f\t%.0f\t%.0f\t%.0f\t%s\n", png, left - wider, top - higher,
        right + wider, bottom + higher, table.concat(colours, " "))
    end
  end
  return table.concat(lines)
end

return pictures
