// The interactive curves: depth downward, drag to move, wheel or two fingers to zoom.
(function () {
  "use strict";
  const data = JSON.parse(document.getElementById("data").textContent);
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const color = (name) =>
    getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // Black is the color of the text, which is light on a dark page.
  const shown = (name) => (name === "black" ? color("--ink") : name);

  const number = (value) => String(Number(value.toPrecision(4)));

  function series(curve) {
    const points = curve.x.map((x, i) => [x, curve.y[i]]);
    if (!curve.to)
      return {
        label: curve.label,
        color: shown(curve.color),
        data: points.filter((p) => p[0] !== null),
        lines: { show: true, lineWidth: curve.full ? 7 : curve.thick ? 2.2 : 1.2 },
        shadowSize: 0,
      };
    const range = curve.y
      .map((y, i) => [y, curve.x[i], curve.to[i]])
      .filter((row) => row[1] !== null && row[2] !== null);
    // the closed line widens the axes
    const back = curve.to.map((x, i) => [x, curve.y[i]]).reverse();
    const closed = points.concat(back).filter((p) => p[0] !== null);
    return {
      label: curve.label,
      color: shown(curve.color),
      range: range,
      shade: curve.shade,
      whiskers: curve.bars, // Flot has an option "bars"
      data: closed,
      hoverable: false,
      lines: { show: true, lineWidth: 0 },
      shadowSize: 0,
    };
  }

  // A range is an area between two thin lines; that of low and high resistance has no
  // lines. The error bar of a run is bars at some depths.
  function drawRanges(plot, context) {
    const offset = plot.getPlotOffset(), ranges = plot.getData().filter((s) => s.range);
    context.save();
    context.beginPath();
    context.rect(offset.left, offset.top, plot.width(), plot.height());
    context.clip();
    ranges.forEach((one, number) => {
      const ends = one.range.map((row) =>
        row.slice(1).map((x) => {
          const at = plot.p2c({ x: x, y: row[0] });
          return [at.left + offset.left, at.top + offset.top];
        })
      );
      context.strokeStyle = context.fillStyle = one.color;
      if (!one.whiskers) {
        context.globalAlpha = 0.16;
        context.beginPath();
        for (const row of ends) context.lineTo(...row[0]);
        for (const row of [...ends].reverse()) context.lineTo(...row[1]);
        context.fill();
        context.globalAlpha = 1;
        context.lineWidth = 0.9;
        for (const side of one.shade ? [] : [0, 1]) {
          context.beginPath();
          for (const row of ends) context.lineTo(...row[side]);
          context.stroke();
        }
        return;
      }
      context.lineWidth = 1.6;
      const step = 48, first = ((number + 1) * step) / (ranges.length + 1);
      let next = first;
      for (const [low, high] of ends) {
        if (low[1] - offset.top < next) continue;
        while (next <= low[1] - offset.top) next += step;
        context.beginPath();
        context.moveTo(...low);
        context.lineTo(high[0], low[1]);
        for (const x of [low[0], high[0]]) {
          context.moveTo(x, low[1] - 4);
          context.lineTo(x, low[1] + 4);
        }
        context.stroke();
      }
    });
    context.restore();
  }

  // The methods widen the axis by at most half of what the run has, limits by all
  // of it, the allowable suction as far as it reaches; content.py has the same end.
  function limits(curves, upward) {
    let low = 0, high = 0, top = upward ? Infinity : 0, bottom = 0, own = 0, full = 0;
    for (const curve of curves.filter((curve) => curve.far))
      for (const y of curve.y) bottom = Math.max(bottom, y);
    for (const curve of curves.filter((curve) => !curve.far))
      for (const list of [curve.x, curve.to || []])
        list.forEach((x, i) => {
          if (x === null) return;
          low = Math.min(low, x);
          high = Math.max(high, x);
          if (curve.thick || curve.shade) own = Math.max(own, x);
          if (curve.full) full = Math.max(full, x);
          top = Math.min(top, curve.y[i]);
          bottom = Math.max(bottom, curve.y[i]);
        });
    // the largest pull is in the middle
    if (own > 0) high = upward ? 2 * own : Math.max(Math.min(high, (full ? 2 : 1.5) * own), full);
    const wide = (high - low || 1) * 0.03, deep = (bottom - top || 1) * 0.02;
    top = Math.min(top, bottom);
    return { low: low - wide, high: high + wide, top: top, bottom: bottom + deep };
  }

  // Flot rounds the labels of steps of a quarter to one digit.
  function tickLabel(value) {
    return String(parseFloat(value.toPrecision(6)));
  }

  function options(figure, box) {
    const turn = (value) => (figure.upward ? value : -value);
    const font = {
      size: 13,
      lineHeight: 16,
      family: "system-ui, sans-serif",
      fill: color("--ink"),
      color: color("--ink"),
    };
    return {
      legend: { show: false },
      grid: {
        hoverable: true,
        borderWidth: 1,
        borderColor: color("--rule"),
        color: color("--ink"),
        mouseActiveRadius: 400,
        // deeper than suction reaches
        markings: figure.end
          ? [{ yaxis: { from: figure.end, to: box.bottom }, color: color("--panel") }]
          : [],
      },
      xaxes: [{
        position: "top", axisLabel: figure.axis, font: font, autoScale: "none",
        min: box.low, max: box.high, tickColor: color("--rule"),
        tickFormatter: tickLabel,
      }],
      yaxes: [{
        position: "left", axisLabel: (figure.upward ? "rise of the caisson" :
          "penetration of the skirt tip") + ` (${figure.depth})`, font: font,
        autoScale: "none", min: box.top, max: box.bottom, tickColor: color("--rule"),
        tickFormatter: tickLabel, transform: turn, inverseTransform: turn,
      }],
      zoom: { interactive: true },
      pan: { interactive: true, enableTouch: true },
      hooks: { draw: [drawRanges] },
    };
  }

  function save(name, type, content) {
    const link = document.createElement("a");
    link.download = name;
    link.href =
      type === "png" ? content : URL.createObjectURL(new Blob([content], { type: type }));
    link.click();
  }

  // The canvas has curves and grid; the texts of the axes are SVG above it.
  function picture(section, use) {
    const sources = [...section.querySelectorAll(".plot canvas.flot-base, .plot svg")];
    const target = document.createElement("canvas");
    $.plot.composeImages(sources, target).then(() => {
      const page = document.createElement("canvas");
      page.width = target.width;
      page.height = target.height;
      const context = page.getContext("2d");
      context.fillStyle = color("--paper");
      context.fillRect(0, 0, page.width, page.height);
      context.drawImage(target, 0, 0);
      use(page.toDataURL("image/png"));
    });
  }

  function Figure(figure) {
    const section = document.getElementById(figure.id);
    const place = $(section.querySelector(".plot"));
    const value = section.querySelector(".value");
    const legend = section.querySelector(".legend");
    const visible = () => figure.curves.filter((curve) => !curve.hidden);

    this.draw = function () {
      $.plot(place, visible().map(series), options(figure, limits(visible(), figure.upward)));
      // a canvas is empty on paper
      const paper = section.querySelector(".paper");
      paper.classList.toggle("dark", dark.matches);
      picture(section, (url) => (paper.src = url));
    };

    function listCurves() {
      legend.replaceChildren();
      const results = (curve) => (curve.thick ? 0 : 1);
      const first = [...figure.curves].sort((a, b) => results(a) - results(b));
      for (const curve of first) {
        const label = document.createElement("label");
        const box = document.createElement("input");
        box.type = "checkbox";
        box.checked = !curve.hidden;
        box.onchange = () => {
          curve.hidden = !box.checked;
          self.draw();
        };
        const mark = document.createElement("i");
        mark.style.color = shown(curve.color);
        if (curve.to) mark.className = curve.bars ? "bars" : "range";
        label.append(box, mark, curve.label);
        legend.append(label);
      }
    }

    const self = this;
    place.on("plothover", (event, position, item) => {
      value.textContent = item
        ? `${item.series.label}: ${number(item.datapoint[0])} at ` +
          `${number(item.datapoint[1])} ${figure.depth}`
        : "\u00a0";
    });
    section.querySelector(".buttons").onclick = (event) => {
      const wanted = event.target.dataset.do;
      if (wanted === "reset") self.draw();
      if (wanted === "csv") save(data.name + "_history.csv", "text/csv", data.csv);
      if (wanted === "png")
        picture(section, (url) => save(`${data.name}_${figure.id}.png`, "png", url));
    };
    this.renew = function () {
      listCurves();
      self.draw();
    };
    this.renew();
  }

  window.addEventListener("beforeprint", () => {
    document.querySelectorAll("details.print").forEach((part) => (part.open = true));
  });
  const figures = data.figures.map((figure) => new Figure(figure));
  const renew = () => figures.forEach((figure) => figure.renew());
  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth !== width) renew();
    width = window.innerWidth;
  });
  dark.addEventListener("change", renew);
})();
