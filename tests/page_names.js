// Controls without a name for those who do not see them.
const name = (e) => (e.getAttribute("aria-label") || e.getAttribute("alt") || e.innerText
  || (e.id && document.querySelector(`label[for="${e.id}"]`)?.innerText)
  || e.closest("label")?.textContent  // also of a label that is folded away
  || e.closest("[role=slider]")?.getAttribute("aria-label") || document.getElementById(e.getAttribute("aria-labelledby"))?.innerText || "").trim();
return [...document.querySelectorAll("button, a[href], input, select, textarea, canvas, [role=slider], [role=button], [role=combobox], [role=switch], [tabindex='0']")]
  .filter((e) => e.type !== "hidden" && !e.closest("[aria-hidden=true]") && !name(e)).map((e) => e.outerHTML.slice(0, 120));
