import assert from "node:assert/strict";
import { test } from "node:test";

import { readDesign } from "../../drapery/web/component/design.js";
import * as model from "../../drapery/web/designer/model.js";

const work = () => model.workOf(readDesign("white creeper:lime border:black"));
const names = ({ layers }) => layers.map(({ pattern }) => pattern).join(" ");

test("layers are added, changed, moved, doubled, hidden and deleted", () => {
  const added = model.withLayer(work(), { pattern: "skull", dye: "red" });
  assert.equal(names(added), "creeper border skull");
  assert.equal(names(model.movedLayer(added, 2, 0)), "skull creeper border");
  assert.equal(names(model.duplicatedLayer(added, 0)), "creeper creeper border skull");
  assert.equal(names(model.withoutLayer(added, 1)), "creeper skull");
  assert.equal(names(model.changedLayer(added, 1, { pattern: "cross" })), "creeper cross skull");
  const hidden = model.changedLayer(added, 1, { hidden: true });
  assert.equal(names(model.shownOf(hidden)), "creeper skull");
  assert.equal(names(added), "creeper border skull");
});

test("there are as many layers as commands give, and no others", () => {
  const full = Array.from({ length: 14 }).reduce((all) => model.withLayer(all, { pattern: "cross", dye: "red" }), work());
  assert.equal(full.layers.length, 16);
  assert.throws(() => model.withLayer(full, { pattern: "cross", dye: "red" }), RangeError);
  assert.throws(() => model.duplicatedLayer(full, 0), RangeError);
  assert.throws(() => model.movedLayer(work(), 0, 2), RangeError);
  assert.throws(() => model.withoutLayer(work(), 2), RangeError);
});

test("everything is undone and done again, and edits with one key are one step", () => {
  const history = new model.History(work());
  assert.equal(history.change(work()), false);
  for (const wind of [5, 6, 7]) history.change({ ...history.work, motion: { ...history.work.motion, wind } }, "wind");
  history.change(model.withoutLayer(history.work, 0));
  assert.ok(history.undo());
  assert.equal(names(history.work), "creeper border");
  assert.equal(history.work.motion.wind, 7);
  assert.ok(history.undo());
  assert.equal(history.work.motion.wind, 4);
  assert.equal(history.undo(), false);
  assert.ok(history.redo() && history.redo());
  assert.equal(names(history.work), "border");
  assert.equal(history.redo(), false);
  history.undo();
  history.change(model.withoutLayer(history.work, 1));
  assert.equal(history.redo(), false);
});

test("a history is kept as text, and no other text is one", () => {
  const history = new model.History(work());
  history.change(model.changedLayer(work(), 0, { hidden: true }));
  const again = model.History.read(history.write());
  assert.deepEqual(again.work, history.work);
  assert.ok(again.undo());
  for (const text of [null, "", "3", "[]", "{}", history.write().replace("lime", "plaid"), history.write().replace("16", "x"), '{"work":{},"past":[],"future":[]}']) {
    if (text === history.write()) continue;
    assert.equal(model.History.read(text), undefined, text);
  }
});

test("a long history forgets its beginning", () => {
  const history = new model.History(work());
  for (let count = 1; count < 300; count++) history.change({ ...history.work, item: { ...history.work.item, count } });
  assert.equal(history.past.length, 200);
  assert.equal(history.past[0].item.count, 99);
});

test("addresses hold the design", () => {
  assert.equal(model.writeHash(model.shownOf(work())), "white,creeper:lime,border:black");
  assert.equal(model.writeHash({ ...model.shownOf(work()), kind: "shield" }), "shield%20white,creeper:lime,border:black");
});
