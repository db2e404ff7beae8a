import { useState } from "react";
import { createRoot } from "react-dom/client";
import "drapery-banner";

function App() {
  const [design, setDesign] = useState("white creeper:lime");
  const [status, setStatus] = useState("Loading");
  return (
    <main>
      <h1>A banner of live cloth</h1>
      <label>
        Design <input value={design} onChange={(event) => setDesign(event.target.value)} />
      </label>
      <p role="status">{status}</p>
      <drapery-banner
        design={design}
        wind="4"
        ondrapery-ready={() => setStatus("Ready")}
        ondrapery-error={(event) => setStatus(event.detail)}
      />
    </main>
  );
}

createRoot(document.body.appendChild(document.createElement("div"))).render(<App />);
