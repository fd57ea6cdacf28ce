-- Figures of the report.
--
--   ``` {.figure}
--   figure: figure_5_7_so_synthesis
--   thesis: Figure 5.7
--   caption: ...
--   ```
--
-- The picture stands in the page as SVG, in the colours of its theme. Everything drawn must be named in the legend of its
-- panel. A line "legend: shared" says that the panels share their legends, "legend: in the picture" that the names stand
-- at the axes or beside what they name. A line "data: table table" names the tables that the picture is drawn from, where
-- that is not the one of its own name.

local captions = require "captions"
local links = require "links"
local manifest = require "manifest"
local pictures = require "pictures"
local print = require "print"
local records = require "records"
local support = require "support"

local figures = {}
local legends = {}

function figures.draw(block)
  local spec = support.settings(block, {figure = true, thesis = true, id = true, legend = true, data = true, caption = true})
  local name = spec.figure or support.fail("a figure of the report has no line 'figure: ...'.")
  if not spec.caption then support.fail("the figure '%s' has no caption.", name) end
  local program = manifest.program_of(name)
  local path = string.format("%s/%s/%s.svg", support.results, program, name)
  local picture = support.read(path, manifest.hint(program))
  if #picture == 0 then support.fail("%s is empty.", path) end
  records.load(program)
  if spec.legend ~= "in the picture" then
    pictures.check_legend(picture, path, spec.legend == "shared")
    local png = path:gsub("svg$", "png")
    if not support.exists(png) then support.fail("%s is not there%s.", png, manifest.hint(program)) end
    legends[#legends + 1] = pictures.legends(picture, png)
  end
  local files = {}
  local function ship(file)
    files[#files + 1] = links.ship("results/" .. program .. "/" .. file, string.format("%s/%s/%s", support.results, program, file))
  end
  for data in (spec.data or name):gmatch("%S+") do
    local path_of_data = string.format("%s/%s/%s.csv", support.results, program, data)
    if not support.exists(path_of_data) then
      support.fail("the figure '%s' is drawn from %s, which is not there; a line 'data: ...' names its tables.", name, path_of_data)
    end
    ship(data .. ".csv")
  end
  ship(name .. ".svg")
  local caption, place, label = captions.make("Figure", spec, name, files, program)
  local svg, width = pictures.prepare(picture, path, label)
  local attributes = {style = "--pixels: " .. width}
  local content = pandoc.RawBlock("html", svg)
  if support.katex then
    attributes.style = print.picture_style(width, name)
    content = pandoc.Plain {pandoc.Image({pandoc.Str(label)}, print.write_picture(name, svg))}
  end
  local box = pandoc.Div({content}, pandoc.Attr("", {"scroll"}, attributes))
  return pandoc.Div({box, pandoc.Para(caption)}, pandoc.Attr(place, {"figure"}))
end

-- Writes for paper/check_legends.py which legends the pictures in PNG must have.
function figures.write_legends(path)
  local file = io.open(path, "w")
  file:write(table.concat(legends))
  file:close()
end

return figures
