// Words whose contrast with the nearest opaque background behind them is too low. Pictures as
// backgrounds are passed over: only the patterns' cells have them, and those bear no words.
const lum = (c) => {
  const [r, g, b] = c.map((v) => v / 255).map((v) => v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4);
  return .2126 * r + .7152 * g + .0722 * b;
};
const parse = (text) => {
  const n = text.match(/[\d.]+/g).map(Number);
  return { rgb: n.slice(0, 3), a: n.length > 3 ? n[3] : 1 };
};
const over = (top, below) => top.rgb.map((v, i) => v * top.a + below[i] * (1 - top.a));
const behind = (element) => {
  if (!element) return [255, 255, 255];
  const colour = parse(getComputedStyle(element).backgroundColor);
  return colour.a === 1 ? colour.rgb : over(colour, behind(element.parentElement));
};
const opacity = (element) => element ? getComputedStyle(element).opacity * opacity(element.parentElement) : 1;
const bad = [];
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
for (let node; (node = walker.nextNode()); ) {
  const element = node.parentElement;
  if (!node.textContent.trim() || !element.checkVisibility({ visibilityProperty: true })) continue;
  if (element.closest("script, style, [disabled], .disabled, option, .viewer, .material-icons, .q-icon, .q-notification, #popup, .nicegui-error-popup")) continue;
  const box = element.getBoundingClientRect();
  if (box.width < 2 || box.height < 2) continue;
  const style = getComputedStyle(element);
  const below = behind(element);
  const ink = parse(style.color);
  ink.a *= opacity(element);
  const [high, low] = [lum(over(ink, below)), lum(below)].sort((a, b) => b - a);
  const ratio = (high + .05) / (low + .05);
  const size = parseFloat(style.fontSize);
  const large = size >= 24 || (size >= 18.66 && style.fontWeight >= 700);
  if (ratio < (large ? 3 : 4.5)) bad.push(`${node.textContent.trim().slice(0, 40)}: ${ratio.toFixed(2)}`);
}
return [...new Set(bad)];
